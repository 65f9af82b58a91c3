// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/opening_views.h>

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <thread>
#include <vector>

#include "tests/support/random_probes.h"
#include "tests/support/window_room.h"

namespace tetralight {
namespace {

class OpeningViewsTest : public testing::Test {
  protected:
    OpeningViewsTest() : scene(test::window_room()) {
        // A screen in the right half of the room.
        test::add_quad(scene, test::wall_material(), {0, 0, 0}, {2, 0, 0}, {0, 3, 0});
        trace_scene.emplace(*TraceScene::make_static(scene));
        openings[0] = {at(test::kWindow), test::kWindowAlong, test::kUp, {0, 0, 1}};
    }

    [[nodiscard]] glm::vec3 at(const glm::dvec3& world) const {
        return trace_scene->render_from_world(world);
    }

    [[nodiscard]] OpeningViews views() const { return {*trace_scene, openings, spots, lights}; }

    Scene scene;
    std::optional<TraceScene> trace_scene;
    std::array<Opening, 1> openings;
    /// The sun falls straight through the window onto the wall at z = 2.
    std::array<Light, 1> lights{Light{.type = LightType::Directional, .direction = {0, 0, 1}}};
    std::array<LitSpot, 1> spots{LitSpot{}};
};

TEST_F(OpeningViewsTest, TellFromWhereAnOpeningIsVisible) {
    const OpeningViews all = views();
    EXPECT_EQ(all.view_from({at({-0.5, 1.5, -1.5})}).openings[0], 1.0f);
    EXPECT_EQ(all.view_from({at({1.9, 1.5, 1.9})}).openings[0], 0.0f) << "behind the screen";
    EXPECT_EQ(all.view_from({at({0, 1.5, -4})}).openings[0], 0.0f) << "bright side";
    // From the middle a part is hidden.
    const float part = all.view_from({at({0.5, 1.5, 0.5})}).openings[0];
    EXPECT_LT(part, 1.0f);
}

TEST_F(OpeningViewsTest, SurfacesLookFromAboveThem) {
    // The cube of 1 m at the wall is half outside; the one above it is inside.
    const OpeningViews all = views();
    EXPECT_EQ(all.view_from({at({-1.9, 1.5, -0.7}), {1, 0, 0}}).openings[0], 1.0f);
}

TEST_F(OpeningViewsTest, TellFromWhereASpotIsVisible) {
    // Half of the light passes beside the screen, onto the wall at z = 2, left of the middle.
    const OpeningViews all = views();
    EXPECT_GT(all.view_from({at({-1.5, 1.5, 1.2})}).spots[0], 0.5f);
    EXPECT_EQ(all.view_from({at({-1.5, 1.5, 9})}).spots[0], 0.0f) << "behind the wall";
}

TEST_F(OpeningViewsTest, AreTheSameInAnyOrderOnAnyThreads) {
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : test::random_positions(500, 1, 2.0)) positions.push_back(at(p));
    const OpeningViews one = views(), other = views();
    std::vector<float> expected;
    for (const glm::vec3& p : positions) expected.push_back(one.view_from({p}).openings[0]);
    // Each thread has an order of its own: the steps and 500 have no common divisor.
    constexpr std::array<size_t, 4> kSteps{1, 3, 7, 9};
    std::array<std::vector<float>, 4> seen;
    {
        std::vector<std::jthread> threads;
        for (size_t t = 0; t < seen.size(); ++t) {
            threads.emplace_back([&, t] {
                seen[t].resize(positions.size());
                for (size_t i = 0; i < positions.size(); ++i) {
                    const size_t k = (i * kSteps[t] + 125 * t) % positions.size();
                    seen[t][k] = other.view_from({positions[k]}).openings[0];
                }
            });
        }
    }
    for (const std::vector<float>& of_thread : seen) EXPECT_EQ(of_thread, expected);
}

}  // namespace
}  // namespace tetralight
