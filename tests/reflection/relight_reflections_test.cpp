// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/relight_reflections.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/reflection/reflection_file.h>
#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

constexpr size_t kLayers = 2;

void relight(Reflections& reflections, const std::vector<LayerWeight>& changes) {
    const auto clamped = relight_reflections(reflections, changes);
    ASSERT_TRUE(clamped) << error_text(clamped.error());
    EXPECT_EQ(*clamped, 0.0);
    EXPECT_TRUE(verify(reflections.view()));
}

/// The texels of a layer, as those of cubes without layers.
std::vector<RadianceTexel> texels_of_layer(const Reflections& all, size_t level, size_t layer) {
    const size_t count = all.levels[level].size() / all.probes.size();
    std::vector<RadianceTexel> texels;
    for (size_t probe = 0; probe < all.probes.size(); ++probe) {
        const auto begin = all.layer_levels[level].begin() +
                           static_cast<ptrdiff_t>((probe * kLayers + layer) * count);
        texels.insert(texels.end(), begin, begin + static_cast<ptrdiff_t>(count));
    }
    return texels;
}

TEST(RelightReflections, OneLayerAloneIsItsLight) {
    Reflections all = test::make_layered_reflections();
    relight(all, {{"sun", 0.0f}, {"lamp", 1.0f}});
    EXPECT_EQ(all.layers[0].weight, 0.0f);
    for (size_t level = 0; level < all.levels.size(); ++level)
        EXPECT_EQ(all.levels[level], texels_of_layer(all, level, 1));
    for (size_t i = 0; i < all.probes.size(); ++i)
        EXPECT_EQ(all.probes[i].irradiance, all.layer_irradiance[kLayers * i + 1]);
}

TEST(RelightReflections, TheLightIsTheSumOfTheLayersByTheirWeights) {
    Reflections all = test::make_layered_reflections();
    relight(all, {{"light:lamp", 3.0f}});
    for (size_t level = 0; level < all.levels.size(); ++level) {
        const auto sun = texels_of_layer(all, level, 0), lamp = texels_of_layer(all, level, 1);
        for (size_t i = 0; i < sun.size(); ++i) {
            for (size_t channel = 0; channel < 3; ++channel) {
                const float sum =
                    float_from_half(sun[i][channel]) + 3.0f * float_from_half(lamp[i][channel]);
                ASSERT_NEAR(float_from_half(all.levels[level][i][channel]), sum,
                            sum * 0x1p-11f + 1e-7f);
            }
        }
    }
}

TEST(RelightReflections, LightAboveTheLargestHalfIsThatOne) {
    Reflections all = test::make_layered_reflections();
    const auto clamped = relight_reflections(all, std::vector<LayerWeight>{{"sun", 1e8f}});
    ASSERT_TRUE(clamped);
    // Random light in [0, 1] of a mean of 0.5, times 1e8.
    EXPECT_NEAR(*clamped, 1.0 - 65504.0 / 0.5e8, 1e-3);
    const auto sun = texels_of_layer(all, 0, 0);
    for (size_t i = 0; i < sun.size(); ++i) {
        if (float_from_half(sun[i][0]) * 1e8f < 65504.0f) continue;
        ASSERT_EQ(float_from_half(all.levels[0][i][0]), 65504.0f);
    }
}

TEST(RelightReflections, RefusesWrongWeightsAndChangesNothing) {
    const Reflections before = test::make_layered_reflections();
    Reflections all = before;
    const auto code_of = [&](const std::vector<LayerWeight>& changes) -> std::optional<ErrorCode> {
        const auto status = relight_reflections(all, changes);
        EXPECT_FALSE(status);
        EXPECT_EQ(reflection_file_bytes(all), reflection_file_bytes(before));
        if (status) return std::nullopt;
        return status.error().code;
    };
    EXPECT_EQ(code_of({{"moon", 1.0f}}), ErrorCode::NotFound);
    EXPECT_EQ(code_of({{"sun", -1.0f}}), ErrorCode::InvalidArgument);
    EXPECT_EQ(code_of({{"sun", std::nanf("")}}), ErrorCode::InvalidArgument);
    Reflections plain = test::make_small_reflections();
    EXPECT_FALSE(relight_reflections(plain, std::vector<LayerWeight>{{"sun", 0.0f}}));
}

}  // namespace
}  // namespace tetralight
