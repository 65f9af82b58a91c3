// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/cover_places.h>

#include <gtest/gtest.h>

#include <tetralight/bake/placement/free_space.h>
#include "tests/bake/placement/grid_support.h"

namespace tetralight {
namespace {

using test::add_box;
using test::Facing;

const WorldBox kRoom{{0, 0, 0}, {4, 3, 4}};
constexpr double kClearance = 0.1;

/// A room with a pillar from its floor to its ceiling.
Scene room_with_pillar() {
    Scene scene;
    add_box(scene, test::grey(), Facing::Inward, {0, 0, 0}, {4, 3, 4});
    add_box(scene, test::grey(), Facing::Outward, {1, -1, 1}, {1.5f, 4, 1.5f});
    return scene;
}

/// A few probes about its centre.
const std::vector<glm::dvec3> kCenter{{2, 1.5, 2}, {2.2, 1.5, 2}, {2, 1.7, 2}, {2, 1.5, 2.2}};

class CoverPlaces : public testing::Test {
  protected:
    CoverPlaces() {
        constexpr double kOff = kClearance + 0.01;
        for (double x = kOff; x < 4.0; x += 0.188) {
            for (double y = kOff; y < 3.0; y += 0.2316) {
                for (double z = kOff; z < 4.0; z += 0.188) {
                    const glm::dvec3 place(x, y, z);
                    if (is_free_with_clearance(*traced_, place, kOff)) places_.push_back(place);
                }
            }
        }
    }

    [[nodiscard]] CoverRule rule(size_t max_count) const {
        const auto is_allowed = [this](const glm::dvec3& position) {
            return is_free_with_clearance(*traced_, position, kClearance);
        };
        return {{kRoom, kClearance, glm::bvec3(true), {}}, 1.0, is_allowed, max_count, 0};
    }

    [[nodiscard]] double covered_by(std::vector<glm::dvec3> added) const {
        added.insert(added.end(), kCenter.begin(), kCenter.end());
        return count_cover(cover_by(*traced_, added, places_, 0)).share(Cover::Covered);
    }

    const Scene scene_ = room_with_pillar();
    const Result<TraceScene> traced_ = TraceScene::make_static(scene_);
    std::vector<glm::dvec3> places_;
};

TEST_F(CoverPlaces, FillARoomWithProbesAtItsCenter) {
    ASSERT_GT(places_.size(), 4000u);
    EXPECT_LT(covered_by({}), 0.01);
    const auto added = cover_places(*traced_, kCenter, places_, rule(1000));
    EXPECT_GT(covered_by(added), 0.99);
    // Eight corners of the room and of the pillar are enough for most of it.
    EXPECT_GE(added.size(), 8u);
    EXPECT_LE(added.size(), 150u);
    for (const glm::dvec3& probe : added) {
        EXPECT_TRUE(is_free_with_clearance(*traced_, probe, 0.999 * kClearance));
    }
}

TEST_F(CoverPlaces, StopAtTheMaximum) {
    EXPECT_EQ(cover_places(*traced_, kCenter, places_, rule(5)).size(), 5u);
    EXPECT_TRUE(cover_places(*traced_, kCenter, places_, rule(0)).empty());
}

TEST_F(CoverPlaces, AddNothingWhereNoProbeMayBe) {
    CoverRule nowhere = rule(1000);
    nowhere.is_allowed = [](const glm::dvec3&) { return false; };
    EXPECT_TRUE(cover_places(*traced_, kCenter, places_, nowhere).empty());
}

TEST_F(CoverPlaces, AddNothingToWhatIsCovered) {
    const auto added = cover_places(*traced_, kCenter, places_, rule(1000));
    std::vector<glm::dvec3> all = kCenter;
    all.insert(all.end(), added.begin(), added.end());
    EXPECT_TRUE(cover_places(*traced_, all, places_, rule(1000)).empty());
}

}  // namespace
}  // namespace tetralight
