// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/estimate_rays.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/base/error_text.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

class EstimateRays : public testing::Test {
  protected:
    EstimateRays() {
        test::add_box(scene, test::diffuse({0.8f, 0.6f, 0.4f}), test::Facing::Inward, {-2, -2, -2},
                      {2, 2, 2});
        test::add_point_light(scene, LightMode::Mixed, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
        positions = test::random_positions(300, 1);
        std::ranges::sort(positions, {}, [](const glm::dvec3& position) { return position.x; });
    }

    /// The estimate over the rays of the bake itself.
    [[nodiscard]] double ratio(const BakeSettings& settings) const {
        const auto estimate = estimate_rays(scene, {positions}, settings, {});
        EXPECT_TRUE(estimate) << error_text(estimate.error());
        EXPECT_GT(estimate->rays_per_second, 0.0);
        std::vector<ProbeAccumulator> accumulators(positions.size());
        EXPECT_TRUE(bake_accumulators(scene, {positions}, settings, accumulators));
        uint64_t rays = 0;
        for (const ProbeAccumulator& accumulator : accumulators) rays += accumulator.ray_count;
        return estimate->rays / static_cast<double>(rays);
    }

    Scene scene;
    std::vector<glm::dvec3> positions;
};

TEST_F(EstimateRays, AreThoseOfABakeWithAFixedNumberOfSamples) {
    BakeSettings settings;
    settings.sample_count = 256;
    EXPECT_NEAR(ratio(settings), 1.0, 0.05);
}

TEST_F(EstimateRays, AreThoseOfABakeToATargetError) {
    BakeSettings settings;
    settings.sample_count = 128;
    settings.target_error = 0.03;
    settings.max_sample_count = 1u << 12;
    EXPECT_NEAR(ratio(settings), 1.0, 0.4);
}

TEST_F(EstimateRays, WithoutPlacesAreNone) {
    const auto estimate = estimate_rays(scene, {}, {}, {});
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->rays, 0.0);
}

}  // namespace
}  // namespace tetralight
