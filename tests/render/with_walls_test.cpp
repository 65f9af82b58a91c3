// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/with_walls.h>

#include <gtest/gtest.h>

#include <tetralight/probes/interpolate.h>

#include "tests/support/random_probes.h"
#include "tests/support/random_walls.h"

namespace tetralight {
namespace {

class WithWalls : public testing::Test {
  protected:
    WithWalls() { test::add_random_walls(volume_, 2); }

    /// Light without an option of the query.
    static InterpolatedProbe light(const ProbeVolumeView& volume, const glm::vec3& position) {
        return interpolate(volume, locate(volume, position));
    }

    ProbeVolume volume_ = test::make_lit_volume(test::random_positions(60, 1, 9.0));
    std::vector<glm::dvec3> positions_ = test::random_positions(200, 3, 9.0);
};

TEST_F(WithWalls, IgnoredWallsGivePlainWeights) {
    const ProbeVolumeView plain = with_walls(volume_.view(), Walls::Ignore);
    size_t changed = 0;
    for (const glm::vec3 p : positions_) {
        const CellLocation location = locate(volume_.view(), p);
        EXPECT_EQ(light(plain, p), interpolate(volume_.view(), location, {Walls::Ignore}));
        changed += light(plain, p) != light(volume_.view(), p);
    }
    EXPECT_GT(changed, positions_.size() / 3);  // more than a third of the edges are blocked
}

TEST_F(WithWalls, HiddenProbesStayHidden) {
    const ProbeVolumeView same = with_walls(volume_.view(), Walls::HideProbes);
    for (const glm::vec3 p : positions_) EXPECT_EQ(light(same, p), light(volume_.view(), p));
}

}  // namespace
}  // namespace tetralight
