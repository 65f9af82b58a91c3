// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/recombine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/detail/recombine_kernel.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/sh_minimum.h>
#include "tests/support/layered_volume.h"

#ifdef TETRALIGHT_HAS_HIGHWAY
#include <hwy/highway.h>
#endif

namespace tetralight {
namespace {

using test::make_layered_volume;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Recombine, IsTheWeightedSumOfTheLayers) {
    ProbeVolume volume = make_layered_volume(100, 3);
    const std::vector<float> weights{0.5f, 0.0f, 2.0f};
    ASSERT_TRUE(recombine(volume, weights));
    const size_t count = volume.positions.size();
    for (size_t i = 0; i < count; ++i) {
        const IrradianceSh sum = 0.5f * volume.layer_irradiance[i] +
                                 0.0f * volume.layer_irradiance[count + i] +
                                 2.0f * volume.layer_irradiance[2 * count + i];
        EXPECT_EQ(volume.irradiance[i], sum);
    }
    EXPECT_EQ(volume.info.ambient, 0.5f * volume.layers[0].ambient +
                                       0.0f * volume.layers[1].ambient +
                                       2.0f * volume.layers[2].ambient);
    EXPECT_EQ(layer_weights(volume.view()), weights);
}

TEST(Recombine, RewritesCompactProbesAndLeavesTheirOcclusion) {
    ProbeVolume volume = make_layered_volume(100, 3);
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
    make_compact_probes(volume);
    const std::vector<CompactProbe> before = volume.compact;
    ASSERT_TRUE(recombine(volume, std::vector<float>{3.0f, 0.5f, 0.25f}));
    EXPECT_EQ(count_wrong_compact_probes(volume.view()), 0u);
    EXPECT_EQ(count_wrong_sums(volume.view()), 0u);
    for (size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(volume.compact[i].occlusion, before[i].occlusion);
        EXPECT_NE(volume.compact[i].irradiance, before[i].irradiance);
    }
    EXPECT_TRUE(verify(volume.view()));
}

TEST(Recombine, GivesTheSameBytesAgainAndForAnyTasks) {
    ProbeVolume a = make_layered_volume(10'000, 4);
    make_compact_probes(a);
    ProbeVolume b = a;
    const std::vector<float> weights{1.0f, 0.3f, 1.7f, 0.9f};
    ASSERT_TRUE(recombine(a, weights));
    const ProbeVolume once = a;
    ASSERT_TRUE(recombine(a, weights));
    EXPECT_EQ(a, once);
    ASSERT_TRUE(recombine(b, weights, [](size_t count, const auto& task) {
        std::vector<std::thread> threads;
        for (size_t i = count; i-- > 0;) threads.emplace_back([i, &task] { task(i); });
        for (std::thread& thread : threads) thread.join();
    }));
    EXPECT_EQ(b, once);
}

TEST(Recombine, StaysNowhereNegativeForAnyWeightsWhenLayersAre) {
    ProbeVolume volume = make_layered_volume(60, 4);
    for (IrradianceSh& light : volume.layer_irradiance) light = dering(light);
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<float> weight(0.0f, 3.0f);
    for (int round = 0; round < 20; ++round) {
        std::vector<float> weights;
        for (int k = 0; k < 4; ++k) weights.push_back(round == 0 ? 0.0f : weight(engine));
        ASSERT_TRUE(recombine(volume, weights));
        for (const IrradianceSh& light : volume.irradiance) {
            const glm::dvec3 least = minimum_irradiance(light);
            const double rounding = -1e-7 * static_cast<double>(light.coefficients[0].x + 1.0f);
            EXPECT_GE(std::min({least.x, least.y, least.z}), rounding);
        }
    }
}

TEST(Recombine, RefusesBadWeights) {
    ProbeVolume volume = make_layered_volume(10, 2);
    const auto error = [&](std::vector<float> weights) {
        const auto status = recombine(volume, weights);
        EXPECT_FALSE(status);
        return status ? "" : error_text(status.error());
    };
    EXPECT_EQ(error({1.0f, -0.5f}), "layer \"light:lamp\": weight -0.5 is negative");
    EXPECT_EQ(error({std::nanf(""), 1.0f}), "layer \"sun\": weight nan is not a number");
    EXPECT_EQ(error({kInfinity, 1.0f}), "layer \"sun\": weight inf is not finite");
    EXPECT_EQ(error({1.0f}), "1 weights for 2 layers");
    EXPECT_EQ(error({1e38f, 1.0f}),
              "layer \"sun\": weight 1e+38 makes its light too bright to be finite");
    volume.layers[1].ambient.coefficients[4].y = -1e37f;
    EXPECT_EQ(error({1.0f, 3.0f}),
              "layer \"light:lamp\": weight 3 makes its light too bright to be finite");
}

TEST(Recombine, OfAVolumeWithoutLayersIsAnErrorThatSaysSo) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(10, 1));
    const auto status = recombine(volume, {});
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              "the volume holds no layers (bake it with --layers to change its light)");
    const LayerWeight lamp{"lamp", 0.0f};
    const auto weights = layer_weights(volume.view(), std::span(&lamp, 1));
    ASSERT_FALSE(weights);
    EXPECT_EQ(error_text(weights.error()), "there is no layer \"lamp\"; it holds no layers");
}

TEST(Recombine, NamesLayersInFullOrByWhatIsBehindTheColon) {
    const ProbeVolume volume = make_layered_volume(5, 4);
    const std::vector<LayerWeight> changes{{"lamp", 0.0f}, {"material:neon", 2.0f}, {"sun", 0.5f}};
    const auto weights = layer_weights(volume.view(), changes);
    ASSERT_TRUE(weights) << error_text(weights.error());
    EXPECT_EQ(*weights, (std::vector<float>{0.5f, 0.0f, 2.0f, 1.0f}));
}

TEST(Recombine, ChangesWeightsThatBelongToNoVolume) {
    const LayerWeight change{"lamp", 3.0f};
    const auto weights = changed_weights("sky\nlight:lamp\n", {0.5f, 1.0f}, std::span(&change, 1));
    ASSERT_TRUE(weights) << error_text(weights.error());
    EXPECT_EQ(*weights, (std::vector<float>{0.5f, 3.0f}));
}

TEST(Recombine, ListsTheLayersWhenANameIsMissing) {
    const ProbeVolume volume = make_layered_volume(5, 3);
    const LayerWeight change{"lantern", 0.0f};
    const auto weights = layer_weights(volume.view(), std::span(&change, 1));
    ASSERT_FALSE(weights);
    EXPECT_EQ(error_text(weights.error()),
              "there is no layer \"lantern\"; it holds \"sun\", \"light:lamp\", \"material:neon\"");
}

TEST(Recombine, RefusesNamesThatMeanTwoLayers) {
    ProbeVolume volume = make_layered_volume(5, 2);
    volume.layer_names = "light:neon\nmaterial:neon\n";
    const LayerWeight change{"neon", 0.0f};
    const auto weights = layer_weights(volume.view(), std::span(&change, 1));
    ASSERT_FALSE(weights);
    EXPECT_EQ(error_text(weights.error()).find("there are several layers \"neon\""), 0u);
}

TEST(Recombine, RefusesTwoWeightsOfOneLayer) {
    const ProbeVolume volume = make_layered_volume(5, 2);
    const std::vector<LayerWeight> changes{{"lamp", 0.0f}, {"light:lamp", 2.0f}};
    const auto weights = layer_weights(volume.view(), changes);
    ASSERT_FALSE(weights);
    EXPECT_EQ(error_text(weights.error()), "layer \"light:lamp\" is given two weights");
}

TEST(Recombine, LightsAreDimmedByTheirLayer) {
    ProbeVolume volume = make_layered_volume(5, 2);
    volume.lights.resize(2);
    volume.light_states.resize(2);
    volume.light_states[1].layer = 1;
    ASSERT_TRUE(recombine(volume, std::vector<float>{1.0f, 0.25f}));
    EXPECT_EQ(light_weight(volume.view(), 0), 1.0f);
    EXPECT_EQ(light_weight(volume.view(), 1), 0.25f);
    EXPECT_EQ(light_weight(volume.view(), 2), 1.0f);
}

// --- Kernels -------------------------------------------------------------------------------------

TEST(RecombineKernel, RoundsHalvesToNearestEven) {
    using tetralight::half_from_float;
    EXPECT_EQ(half_from_float(1.0f), 0x3c00);
    EXPECT_EQ(half_from_float(-2.0f), 0xc000);
    EXPECT_EQ(half_from_float(1.0f + 0x1p-11f), 0x3c00);  // a tie, to even
    EXPECT_EQ(half_from_float(1.0f + 3 * 0x1p-11f), 0x3c02);
    EXPECT_EQ(half_from_float(1.0f + 0x1p-11f + 0x1p-20f), 0x3c01);
    EXPECT_EQ(half_from_float(0x1p-24f), 0x0001);
    EXPECT_EQ(half_from_float(0x1p-25f), 0x0000);  // a tie, to even
    EXPECT_EQ(half_from_float(3 * 0x1p-25f), 0x0002);
    EXPECT_EQ(half_from_float(65504.0f), 0x7bff);
    EXPECT_EQ(half_from_float(65520.0f), 0x7c00);
    EXPECT_EQ(half_from_float(1e30f), 0x7c00);
}

#ifdef TETRALIGHT_HAS_HIGHWAY
TEST(RecombineKernel, VectorCodeGivesTheBitsOfItsScalarTwin) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f), exponent(-26.0f, 11.0f);
    constexpr size_t kCount = 1003, kLayers = 4;
    std::vector<float> layers(kLayers * kCount);
    for (float& f : layers) f = value(engine) * std::exp2(exponent(engine));
    const std::vector<float> weights{1.0f, 0.37f, 0.0f, 2.5f};
    std::vector<float> a(kCount), b(kCount);
    std::vector<uint16_t> half_a(kCount), half_b(kCount);
    detail::RecombineBlock block{layers.data(), kCount, weights, kCount, a.data(), half_a.data()};
    detail::recombine_floats(block);
    block.sums = b.data();
    block.halves = half_b.data();
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::ranges::fill(b, -1.0f);
        detail::recombine_floats_in_vectors(block);
        EXPECT_EQ(a, b) << hwy::TargetName(target);
        EXPECT_EQ(half_a, half_b) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#endif

}  // namespace
}  // namespace tetralight
