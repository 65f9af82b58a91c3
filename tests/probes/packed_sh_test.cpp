// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/packed_sh.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace tetralight {
namespace {

TEST(PackedSh, EvaluatesToIrradianceOverPi) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    for (int trial = 0; trial < 1000; ++trial) {
        IrradianceSh sh;
        for (glm::vec3& c : sh.coefficients) c = {value(engine), value(engine), value(engine)};
        const glm::vec3 n = glm::normalize(glm::vec3(value(engine), value(engine), value(engine)));
        const glm::vec3 expected = evaluate_irradiance(sh, n) * std::numbers::inv_pi_v<float>;
        EXPECT_LT(glm::distance(sample_sh9(pack_sh(sh), n), expected), 2e-6f);
    }
}

TEST(PackedSh, ConstantRadianceIsOneInEveryDirection) {
    const PackedSh sh = pack_sh(irradiance_from_radiance(constant_radiance(glm::vec3(1.0f))));
    EXPECT_NEAR(sh.sha_r.w, 1.0f, 1e-6f);
    EXPECT_NEAR(sample_sh9(sh, {0, 0, 1}).y, 1.0f, 1e-6f);
}

TEST(PackedSh, HoldsTheTermsInTheOrderOfTheShaderConvention) {
    // One coefficient at a time: x → sha.x, y → sha.y, z → sha.z, xy → shb.x, yz → shb.y, xz →
    // shb.w.
    const auto packed = [](int coefficient) {
        IrradianceSh sh;
        sh.coefficients[coefficient].x = 1.0f;
        return pack_sh(sh);
    };
    EXPECT_GT(packed(3).sha_r.x, 0.0f);
    EXPECT_GT(packed(1).sha_r.y, 0.0f);
    EXPECT_GT(packed(2).sha_r.z, 0.0f);
    EXPECT_GT(packed(4).shb_r.x, 0.0f);
    EXPECT_GT(packed(5).shb_r.y, 0.0f);
    EXPECT_FLOAT_EQ(packed(6).shb_r.z, -3.0f * packed(6).sha_r.w);
    EXPECT_GT(packed(7).shb_r.w, 0.0f);
    EXPECT_GT(packed(8).shc.x, 0.0f);
}

}  // namespace
}  // namespace tetralight
