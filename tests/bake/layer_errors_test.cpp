// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/layer_errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/round_variance.h>
#include <tetralight/base/error_text.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

/// A room lit by a panel, a lamp and a faint floor, with a box that throws shadows.
Scene room() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.7f, 0.5f, 0.3f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_box(scene, test::diffuse({0.2f, 0.6f, 0.9f}), test::Facing::Outward, {-1, -2, -1},
                  {0, -1, 0});
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.5f), {9, 8, 7}), 0.5f, 1.99f);
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(0.05f)), 1.0f, -1.5f);
    test::add_point_light(scene, LightMode::Mixed, {5, 5, 9}, {1, 1.5f, 1}).radius = 0.1f;
    return scene;
}

/// Layers "panel" and "lamp"; the light of the floor is the rest.
LightPlan plan() {
    LightPlan plan;
    plan.layer_count = 2;
    plan.layer_of_material = {kNoIndex, kNoIndex, 0, kNoIndex};
    plan.layer_of_light = {1};
    plan.has_rest = true;
    return plan;
}

std::vector<glm::dvec3> some_positions(size_t count) {
    return test::random_positions(count, 1, 1.9);
}

BakeSettings fixed(uint32_t samples, uint32_t thread_count = 0) {
    BakeSettings settings;
    settings.sample_count = samples;
    settings.thread_count = thread_count;
    settings.plan = plan();
    return settings;
}

/// The layers take up to eight times the samples that the sum alone takes.
BakeSettings with_layer_target(uint32_t thread_count = 0) {
    BakeSettings settings = fixed(128, thread_count);
    settings.target_error = 0.2;
    settings.target_layer_error = 0.1;
    settings.max_sample_count = 1024;
    return settings;
}

struct Baked {
    std::vector<ProbeAccumulator> accumulators;
    std::vector<double> rows;

    bool operator==(const Baked&) const = default;

    [[nodiscard]] std::span<const double> row(size_t probe) const {
        const size_t size = rows.size() / accumulators.size();
        return std::span(rows).subspan(probe * size, size);
    }
};

Baked bake(const std::vector<glm::dvec3>& positions, const BakeSettings& settings, Baked baked = {},
           const BakeHooks& hooks = {}) {
    baked.accumulators.resize(positions.size());
    baked.rows.resize(positions.size() * LightGroupLayout(settings.plan).size());
    const Status status = bake_accumulators(room(), {positions}, settings, baked.accumulators,
                                            hooks, {baked.rows, {}});
    EXPECT_TRUE(status || status.error().code == ErrorCode::Cancelled);
    return baked;
}

/// The mean light of one layer, or of the rest.
RadianceSums light_of(const Baked& baked, size_t probe, uint32_t layer) {
    const auto row = baked.row(probe);
    const auto layer_light = [&](uint32_t which) {
        RadianceSums light{};
        for (size_t i = 0; i < 27; ++i) light[i / 3][static_cast<int>(i % 3)] = row[which * 27 + i];
        return light;
    };
    const ProbeAccumulator& accumulator = baked.accumulators[probe];
    RadianceSums light = layer < 2 ? layer_light(layer) : accumulator.radiance_sum;
    for (size_t i = 0; i < light.size(); ++i) {
        if (layer == 2) light[i] -= layer_light(0)[i] + layer_light(1)[i];
        light[i] /= static_cast<double>(accumulator.sample_count);
    }
    return light;
}

TEST(LayerErrors, MatchTheErrorsOfEachLayerAndOfTheRest) {
    constexpr uint64_t kSeeds = 8;
    const LightGroupLayout layout(plan());
    const auto positions = some_positions(41);
    const Baked reference = bake(positions, fixed(32 * 1024));
    std::vector<std::vector<double>> squares(3, std::vector<double>(positions.size(), 0.0));
    std::vector<std::vector<double>> predicted = squares;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        BakeSettings settings = fixed(1024);
        settings.seed = seed;
        const Baked baked = bake(positions, settings);
        for (size_t i = 0; i < positions.size(); ++i) {
            const auto errors = layer_errors(layout, baked.accumulators[i], baked.row(i));
            ASSERT_EQ(errors.size(), 3u);
            for (uint32_t layer = 0; layer < 3; ++layer) {
                const RadianceSums truth = light_of(reference, i, layer);
                RadianceSums difference = light_of(baked, i, layer);
                for (size_t k = 0; k < truth.size(); ++k) difference[k] -= truth[k];
                squares[layer][i] += irradiance_square(difference) / irradiance_square(truth);
                predicted[layer][i] += std::pow(static_cast<double>(errors[layer]), 2.0);
            }
        }
    }
    for (uint32_t layer = 0; layer < 3; ++layer) {
        std::vector<double> ratios;
        for (size_t i = 0; i < positions.size(); ++i) {
            ratios.push_back(std::sqrt(predicted[layer][i] / squares[layer][i]));
        }
        std::ranges::nth_element(ratios, ratios.begin() + 20);
        EXPECT_GT(ratios[20], 0.8) << layer;
        EXPECT_LT(ratios[20], 1.25) << layer;
    }
}

TEST(LayerErrors, OfTheOnlyLayerAreThoseOfTheSum) {
    BakeSettings settings = fixed(256);
    settings.plan = {};
    settings.plan.layer_count = 1;
    settings.plan.layer_of_material.assign(4, 0);
    settings.plan.layer_of_light = {0};
    const Baked baked = bake(some_positions(5), settings);
    for (size_t i = 0; i < 5; ++i) {
        const auto errors =
            layer_errors(LightGroupLayout(settings.plan), baked.accumulators[i], baked.row(i));
        ASSERT_EQ(errors.size(), 1u);
        const float expected = baked.accumulators[i].sampling_error();
        EXPECT_NEAR(errors[0], expected, 1e-4f * expected);
    }
}

TEST(LayerErrors, SameBitsForThreadsSubsetsAndInterruptions) {
    const auto positions = some_positions(30);
    const BakeSettings settings = with_layer_target();
    const Baked whole = bake(positions, with_layer_target(1));
    EXPECT_EQ(bake(positions, with_layer_target(2)), whole);
    Baked parts;
    for (const auto& [begin, end] : {std::pair{0, 7}, std::pair{7, 30}}) {
        const Baked part = bake({positions.begin() + begin, positions.begin() + end}, settings);
        parts.accumulators.insert(parts.accumulators.end(), part.accumulators.begin(),
                                  part.accumulators.end());
        parts.rows.insert(parts.rows.end(), part.rows.begin(), part.rows.end());
    }
    EXPECT_EQ(parts, whole);
    std::atomic<int> left = 1;
    const BakeHooks hooks{.progress = [&](const BakeProgress&) { return --left > 0; }};
    EXPECT_EQ(bake(positions, settings, bake(positions, settings, {}, hooks)), whole);
}

TEST(LayerErrors, EveryLayerReachesItsTargetOrTheMaximum) {
    BakeSettings without = with_layer_target();
    without.target_layer_error = 0.0;
    const auto positions = some_positions(30);
    const Baked sum_only = bake(positions, without);
    const BakeSettings settings = with_layer_target();
    const Baked baked = bake(positions, settings);
    const std::vector<double> no_scale(3, 0.0);
    uint64_t samples = 0, samples_before = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        const ProbeAccumulator& accumulator = baked.accumulators[i];
        const float worst =
            worst_layer_error(LightGroupLayout(plan()), accumulator, baked.row(i), no_scale);
        EXPECT_TRUE(worst <= settings.target_layer_error ||
                    accumulator.sample_count == settings.max_sample_count)
            << i << " " << worst;
        samples += accumulator.sample_count;
        samples_before += sum_only.accumulators[i].sample_count;
    }
    EXPECT_GT(samples, samples_before);
}

TEST(LayerErrors, AreRelativeToAHundredthOfTheMeanLightWhereALayerIsFaint) {
    LightPlan one;
    one.layer_count = 1;
    const LightGroupLayout layout(one);
    ProbeAccumulator accumulator;
    accumulator.sample_count = 100;
    std::vector<double> row(layout.size(), 0.0);
    row[0] = 100 * 0.001;                                   // red radiance 0.001
    row[layout.variance_begin()] = std::pow(100 * 0.5, 2);  // standard error 0.5
    const double light = kPi * 0.001;
    EXPECT_NEAR(worst_layer_error(layout, accumulator, row, std::vector{0.0}), 0.5 / light, 1e-2);
    EXPECT_NEAR(worst_layer_error(layout, accumulator, row, std::vector{50.0}), 1.0, 1e-6);
    EXPECT_NEAR(layer_errors(layout, accumulator, row)[0], 0.5 / light, 1e-2);
}

TEST(LayerErrors, MeanLightOfAFurnaceIsItsRadiance) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(1.0f)), test::Facing::Inward,
                  {-1, -2, -1}, {3, 1, 1});
    LightPlan all;
    all.layer_count = 1;
    all.layer_of_material = {0};
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const PathTracer tracer(scene, *traced, {}, all);
    const std::vector<double> mean = mean_layer_light(scene, tracer, 1, 2);
    ASSERT_EQ(mean.size(), 1u);
    // Radiance 2 from everywhere, in three channels: coefficient 0 is 2 √4π.
    EXPECT_NEAR(mean[0], kPi * 2.0 * std::sqrt(4.0 * kPi) * std::sqrt(3.0), 0.05 * mean[0]);
    EXPECT_EQ(mean_layer_light(scene, tracer, 1, 1), mean);
}

}  // namespace
}  // namespace tetralight
