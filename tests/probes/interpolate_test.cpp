// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/interpolate.h>

#include <gtest/gtest.h>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(Interpolate, ReproducesALinearFieldInsideTheHull) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(300, 1));
    for (const glm::dvec3& p : test::random_positions(1000, 2, 0.5)) {
        const auto result = interpolate(volume.view(), locate(volume.view(), glm::vec3(p)));
        const IrradianceSh expected = test::linear_light(p);
        for (int k = 0; k < kShCoefficientCount; ++k) {
            EXPECT_LT(glm::distance(result.irradiance.coefficients[k], expected.coefficients[k]),
                      1e-5f);
        }
    }
}

TEST(Interpolate, WithoutProbesTheAnswerIsAmbientAndLit) {
    ProbeVolume volume;
    volume.info.ambient = test::linear_light({1, 2, 3});
    const auto result = interpolate(volume.view(), locate(volume.view(), {4, 5, 6}));
    EXPECT_EQ(result.irradiance, volume.info.ambient);
    EXPECT_EQ(result.occlusion, glm::vec4(1.0f));
}

TEST(Interpolate, WithoutBakedLightTheAnswerIsAmbient) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 3));
    volume.irradiance.clear();
    volume.info.ambient = test::linear_light({1, 2, 3});
    const auto result = interpolate(volume.view(), locate(volume.view(), {0, 0, 0}));
    EXPECT_EQ(result.irradiance, volume.info.ambient);
}

TEST(Interpolate, BlendsOcclusionByTheSameWeights) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 4));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.occlusion.emplace_back(0.5 + 0.25 * p.x, 0.5 + 0.25 * p.y, 0.5 + 0.25 * p.z, 1.0);
    }
    const glm::vec3 p(0.1f, -0.2f, 0.3f);
    const glm::vec4 occlusion = interpolate(volume.view(), locate(volume.view(), p)).occlusion;
    EXPECT_LT(glm::distance(occlusion, glm::vec4(0.5f + 0.25f * p, 1.0f)), 1e-6f);
}

}  // namespace
}  // namespace tetralight
