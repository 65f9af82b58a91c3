// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/trace_light.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/window_room.h"

namespace tetralight {
namespace {

class TraceLight : public testing::Test {
  protected:
    TraceLight() : scene_(test::window_room()), traced_(make_traced(scene_)) {}

    static Scene with_sky(Scene scene) {
        scene.environment.radiance = {1.0f, 0.8f, 0.6f};
        return scene;
    }

    static TraceScene make_traced(Scene& scene) {
        scene = with_sky(std::move(scene));
        return std::move(*TraceScene::make_static(scene));
    }

    [[nodiscard]] TracedLight trace(const TraceEffort& effort) const {
        return trace_light(PlainTracer(scene_, traced_, {}), {0.5, 1.2, 0.5}, effort);
    }

    Scene scene_;
    TraceScene traced_;
};

TEST_F(TraceLight, IsAFunctionOfSeedAndPosition) {
    const TracedLight light = trace({.sample_count = 4096, .seed = 3});
    EXPECT_EQ(light, trace({.sample_count = 4096, .seed = 3}));
    EXPECT_NE(light.mean, trace({.sample_count = 4096, .seed = 4}).mean);
    EXPECT_EQ(light.sample_count, 4096u);
}

/// The spread of independent runs is as wide as their error bars say.
TEST_F(TraceLight, ErrorBarsMatchTheSpread) {
    constexpr int kRuns = 64;
    const TracedLight truth = trace({.sample_count = 1 << 20, .seed = 1000});
    double squares = 0.0;
    for (int seed = 0; seed < kRuns; ++seed) {
        const TracedLight light = trace({.sample_count = 16384, .seed = uint64_t(seed)});
        const double z = (light.mean.y - truth.mean.y) / std::hypot(light.error.y, truth.error.y);
        squares += z * z / kRuns;
    }
    // Four standard deviations of the mean of squares: 4 √(2/64).
    EXPECT_NEAR(squares, 1.0, 0.75);
}

TEST_F(TraceLight, TakesThePathsThatTheTargetNeeds) {
    const TracedLight light = trace({.target_error = 0.02});
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_LT(light.error[channel] / light.mean[channel], 1.5 * 0.02);
    }
    EXPECT_LT(light.sample_count, trace({.target_error = 0.01}).sample_count);
    EXPECT_EQ(trace({.target_error = 1e-6, .max_sample_count = 8192}).sample_count, 8192u);
}

TEST_F(TraceLight, MeanIsThatOfTheFirstCoefficient) {
    const TracedLight light = trace({.sample_count = 4096});
    const glm::dvec3 mean = mean_over_normals(light.irradiance);
    EXPECT_NEAR(light.mean.x, mean.x, 1e-5 * mean.x);
}

}  // namespace
}  // namespace tetralight
