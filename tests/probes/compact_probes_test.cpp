// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/compact_probes.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

ProbeVolume volume_with_largest(float largest) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1));
    volume.irradiance[7].coefficients[3].y = -largest;
    make_compact_probes(volume);
    return volume;
}

TEST(CompactProbes, KeepElevenBitsOfEveryCoefficient) {
    for (const float largest : {100.0f, 4096.0f, 1e6f, 1e30f}) {
        const ProbeVolume volume = volume_with_largest(largest);
        for (size_t i = 0; i < volume.irradiance.size(); ++i) {
            const auto sh = compact_irradiance(volume.compact[i], volume.info.compact_scale);
            for (int k = 0; k < kShCoefficientCount; ++k) {
                const glm::vec3 exact = volume.irradiance[i].coefficients[k];
                const glm::vec3 error = glm::abs(sh.coefficients[k] - exact);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_LE(error[c], 0x1p-11f * std::abs(exact[c]) + 0x1p-36f * largest);
                }
            }
        }
    }
}

TEST(CompactProbes, ScaleBringsTheLargestCoefficientToItsPlace) {
    // The halves of the largest coefficient lie in (2^11, 2^12].
    for (const float largest : {4096.0f, 4097.0f, 8192.0f, 3e7f}) {
        const float scaled = largest / volume_with_largest(largest).info.compact_scale;
        EXPECT_LE(scaled, 0x1p12f);
        EXPECT_GT(scaled, 0x1p11f);
    }
}

TEST(CompactProbes, HoldOcclusionAndValidityOrSayLit) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(5, 2));
    make_compact_probes(volume);
    EXPECT_EQ(compact_occlusion(volume.compact[0]), glm::vec4(1.0f));
    volume.occlusion.assign(5, {0.0f, 0.25f, 0.5f, 0.75f});
    volume.validity.assign(5, 0.5f);
    make_compact_probes(volume);
    EXPECT_EQ(compact_occlusion(volume.compact[4]), glm::vec4(0.0f, 0.25f, 0.5f, 0.75f));
    EXPECT_EQ(volume.compact[4].validity, 0x3800);  // one half
}

TEST(CompactProbes, BlackVolumesStayBlack) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(5, 3));
    for (IrradianceSh& sh : volume.irradiance) sh = {};
    make_compact_probes(volume);
    EXPECT_GT(volume.info.compact_scale, 0.0f);
    EXPECT_EQ(compact_irradiance(volume.compact[0], volume.info.compact_scale), IrradianceSh{});
}

TEST(CompactProbes, AreVerified) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(5, 4));
    make_compact_probes(volume);
    EXPECT_TRUE(verify(volume.view()));
    volume.compact[2].irradiance[5] = 0x7c00;  // infinity
    EXPECT_FALSE(verify(volume.view()));
    make_compact_probes(volume);
    volume.compact.pop_back();
    EXPECT_FALSE(verify(volume.view()));
    make_compact_probes(volume);
    volume.info.compact_scale = 0.0f;
    EXPECT_FALSE(verify(volume.view()));
}

}  // namespace
}  // namespace tetralight
