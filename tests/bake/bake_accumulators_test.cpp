// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_accumulators.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using Tallies = std::vector<ProbeAccumulator>;

/// A room with a bright panel, a box that throws shadows and a glass panel: several sources of
/// noise.
Scene noisy_room() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.7f, 0.5f, 0.3f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_box(scene, test::diffuse({0.2f, 0.6f, 0.9f}), test::Facing::Outward, {-1, -2, -1},
                  {0, -1, 0});
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.5f), {9, 8, 7}), 0.5f, 1.99f);
    Material glass = test::diffuse(glm::vec3(0.3f));
    glass.base_color.a = 0.5f;
    glass.alpha_mode = AlphaMode::Blend;
    glass.is_double_sided = true;
    test::add_floor(scene, glass, 1.0f, 0.5f);
    return scene;
}

std::vector<glm::dvec3> some_positions(size_t count) {
    return test::random_positions(count, 1, 1.9);
}

BakeSettings fixed(uint32_t samples = 256, uint32_t thread_count = 0) {
    BakeSettings settings;
    settings.sample_count = samples;
    settings.thread_count = thread_count;
    return settings;
}

Tallies bake(const std::vector<glm::dvec3>& positions, const BakeSettings& settings,
             Tallies accumulators = {}, const BakeHooks& hooks = {}) {
    accumulators.resize(positions.size());
    const Status status =
        bake_accumulators(noisy_room(), {positions}, settings, accumulators, hooks);
    EXPECT_TRUE(status) << error_text(status.error());
    return accumulators;
}

/// Median error of one round of 128 directions, so that some probes are below it, some above.
double typical_error() {
    std::vector<float> errors;
    for (const ProbeAccumulator& accumulator : bake(some_positions(31), fixed(128))) {
        errors.push_back(accumulator.standard_error());
    }
    std::ranges::nth_element(errors, errors.begin() + 15);
    return errors[15];
}

BakeSettings adaptive(uint32_t thread_count = 0) {
    static const double target = 0.7 * typical_error();
    BakeSettings settings = fixed(128, thread_count);
    settings.target_error = target;
    settings.max_sample_count = 1024;
    return settings;
}

/// Cancels a bake at its n-th report and returns what it left.
Tallies interrupted(const std::vector<glm::dvec3>& positions, const BakeSettings& settings,
                    int reports, Tallies accumulators = {}) {
    accumulators.resize(positions.size());
    std::atomic<int> left = reports;
    const BakeHooks hooks{.progress = [&](const BakeProgress&) { return --left > 0; }};
    const Status status =
        bake_accumulators(noisy_room(), {positions}, settings, accumulators, hooks);
    EXPECT_TRUE(!status || left > 0);
    return accumulators;
}

TEST(BakeAccumulators, SameBitsForAnyNumberOfThreadsAdaptiveOrNot) {
    const auto positions = some_positions(30);
    EXPECT_EQ(bake(positions, fixed(256, 1)), bake(positions, fixed(256, 2)));
    EXPECT_EQ(bake(positions, adaptive(1)), bake(positions, adaptive(2)));
}

TEST(BakeAccumulators, SameBitsForAnySubsetOfThePositions) {
    const auto positions = some_positions(30);
    const Tallies whole = bake(positions, adaptive());
    Tallies parts;
    for (const auto& [begin, end] : {std::pair{0, 7}, std::pair{7, 8}, std::pair{8, 30}}) {
        const Tallies part = bake({positions.begin() + begin, positions.begin() + end}, adaptive());
        parts.insert(parts.end(), part.begin(), part.end());
    }
    EXPECT_EQ(parts, whole);
}

TEST(BakeAccumulators, ContinuesToTheSameBitsWhereverItStopped) {
    const auto positions = some_positions(200);
    for (const BakeSettings& settings : {fixed(2048), adaptive()}) {
        const Tallies whole = bake(positions, settings);
        Tallies stopped = interrupted(positions, settings, 1);
        EXPECT_TRUE(std::ranges::any_of(stopped, [](const ProbeAccumulator& accumulator) {
            return accumulator.round_count == 0;
        }));
        stopped = interrupted(positions, settings, 2, stopped);
        EXPECT_EQ(bake(positions, settings, stopped), whole);
    }
}

TEST(BakeAccumulators, FinishedProbesTakeNoMoreRays) {
    const auto positions = some_positions(5);
    const Tallies done = bake(positions, adaptive());
    BakeProgress last;
    const BakeHooks hooks{.progress = [&](const BakeProgress& progress) {
        last = progress;
        return true;
    }};
    EXPECT_EQ(bake(positions, adaptive(), done, hooks), done);
    EXPECT_EQ(last.ray_count, 0u);
    EXPECT_EQ(last.probes_done, 5u);
}

TEST(BakeAccumulators, EveryProbeReachesTheTargetOrTheMaximum) {
    BakeSettings settings = adaptive();
    std::vector<uint64_t> counts;
    for (const ProbeAccumulator& accumulator : bake(some_positions(30), settings)) {
        const bool is_below = accumulator.standard_error() <= settings.target_error;
        EXPECT_TRUE(is_below || accumulator.sample_count == settings.max_sample_count);
        counts.push_back(accumulator.sample_count);
    }
    EXPECT_LT(std::ranges::min(counts), std::ranges::max(counts));
    settings.max_sample_count = 1 << 20;
    for (const ProbeAccumulator& accumulator : bake(some_positions(30), settings)) {
        EXPECT_LE(accumulator.standard_error(), settings.target_error);
    }
}

TEST(BakeAccumulators, ATimeBudgetEndsRoundsButNotTheFirst) {
    BakeSettings settings = fixed(128);
    settings.time_budget_seconds = 1e-9;
    for (const ProbeAccumulator& accumulator : bake(some_positions(10), settings)) {
        EXPECT_EQ(accumulator.sample_count, 128u);
    }
    settings.time_budget_seconds = 1e9;
    settings.max_sample_count = 1024;
    for (const ProbeAccumulator& accumulator : bake(some_positions(10), settings)) {
        EXPECT_EQ(accumulator.sample_count, 1024u);
    }
}

TEST(BakeAccumulators, ATimeBudgetGivesTheBitsOfAsManyRounds) {
    const auto positions = some_positions(40);
    for (const double seconds : {1e-9, 0.02, 0.1}) {
        BakeSettings settings = fixed(128);
        settings.time_budget_seconds = seconds;
        settings.max_sample_count = 1 << 24;
        uint64_t samples = 0;
        const BakeHooks hooks{.out_of_time = [&](uint64_t count) { samples = count; }};
        const Tallies in_time = bake(positions, settings, {}, hooks);
        EXPECT_GE(samples, 128u);
        settings.time_budget_seconds = 0.0;
        settings.max_sample_count = samples;
        EXPECT_EQ(bake(positions, settings), in_time);
    }
}

TEST(BakeAccumulators, ARoundThatHasBegunEndsInSpiteOfTheTimeBudget) {
    const auto positions = some_positions(10);
    BakeSettings settings = fixed(128);
    settings.max_sample_count = 512;
    const Tallies whole = bake(positions, settings);
    settings.max_sample_count = 256;
    Tallies begun = bake(positions, settings);
    settings.max_sample_count = 128;
    const Tallies before = bake(positions, fixed(128));
    std::copy(before.begin() + 5, before.end(), begun.begin() + 5);
    settings.max_sample_count = 512;
    settings.time_budget_seconds = 1e-9;
    for (const ProbeAccumulator& accumulator : bake(positions, settings, begun))
        EXPECT_EQ(accumulator.sample_count, 256u);
    settings.time_budget_seconds = 0.0;
    EXPECT_EQ(bake(positions, settings, begun), whole);
}

TEST(BakeAccumulators, CountsProbesAtTheTarget) {
    const auto positions = some_positions(30);
    BakeProgress last;
    const BakeHooks hooks{.progress = [&](const BakeProgress& progress) {
        last = progress;
        return true;
    }};
    BakeSettings settings = adaptive();
    settings.max_sample_count = 256;
    const Tallies done = bake(positions, settings, {}, hooks);
    const auto at_target = std::ranges::count_if(done, [&](const ProbeAccumulator& accumulator) {
        return double{accumulator.sampling_error(ErrorMeasure::AllNormals)} <=
               settings.target_error;
    });
    EXPECT_TRUE(last.has_target);
    EXPECT_EQ(last.probes_at_target, static_cast<size_t>(at_target));
    EXPECT_LT(at_target, 30);
    EXPECT_GT(at_target, 0);
    last = {};
    (void)bake(positions, settings, done, hooks);  // nothing is left to do
    EXPECT_EQ(last.probes_at_target, static_cast<size_t>(at_target));
    (void)bake(positions, fixed(128), {}, hooks);
    EXPECT_FALSE(last.has_target);
}

TEST(BakeAccumulators, PreviewsChangeNoBits) {
    const auto positions = some_positions(40);
    size_t count = 0;
    const BakeHooks hooks{.preview = [&] { ++count; }, .preview_seconds = 0.0};
    EXPECT_EQ(bake(positions, adaptive(), {}, hooks), bake(positions, adaptive()));
    EXPECT_GT(count, 0u);
}

TEST(BakeAccumulators, SavesWhileNoAccumulatorChanges) {
    // Rounds of 2^17 directions are baked 16 probes at a time.
    const auto positions = std::vector<glm::dvec3>(some_positions(40));
    Tallies accumulators(positions.size());
    std::vector<size_t> begun;
    const BakeHooks hooks{
        .save =
            [&] {
                begun.push_back(std::ranges::count_if(
                    accumulators, [](const auto& t) { return t.round_count > 0; }));
            },
        .save_seconds = 0.0};
    ASSERT_TRUE(bake_accumulators(Scene{}, {positions}, fixed(1 << 17), accumulators, hooks));
    ASSERT_FALSE(begun.empty());
    EXPECT_EQ(begun[0], 16u);
}

TEST(BakeAccumulators, ProgressGrowsToItsEnd) {
    std::vector<BakeProgress> reports;
    const BakeHooks hooks{.progress = [&](const BakeProgress& progress) {
        reports.push_back(progress);
        return true;
    }};
    const Tallies accumulators = bake(some_positions(100), adaptive(2), {}, hooks);
    ASSERT_FALSE(reports.empty());
    EXPECT_EQ(reports.back().probes_done, 100u);
    EXPECT_EQ(reports.back().fraction_done, 1.0);
    float worst = 0.0f;
    for (const ProbeAccumulator& accumulator : accumulators)
        worst = std::max(worst, accumulator.standard_error());
    EXPECT_GE(reports.back().worst_error, worst);
}

/// Relative error of irradiance over all normals and channels.
double relative_error(const RadianceSh& actual, const RadianceSh& expected) {
    const IrradianceSh a = irradiance_from_radiance(actual), b = irradiance_from_radiance(expected);
    double error = 0.0, square = 0.0;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const glm::vec3 d = a.coefficients[i] - b.coefficients[i], e = b.coefficients[i];
        error += d.x * d.x + d.y * d.y + d.z * d.z;
        square += e.x * e.x + e.y * e.y + e.z * e.z;
    }
    return std::sqrt(error / square);
}

TEST(BakeAccumulators, StandardErrorsMatchTheErrors) {
    // Errors of one bake scatter about their root mean square, which is the standard error.
    constexpr uint64_t kSeeds = 8;
    const auto positions = some_positions(41);
    const Tallies reference = bake(positions, fixed(32 * 1024));
    std::vector<double> squares(positions.size(), 0.0), ratios;
    Tallies accumulators;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        BakeSettings settings = fixed(1024);
        settings.seed = seed;
        accumulators = bake(positions, settings);
        for (size_t i = 0; i < positions.size(); ++i) {
            squares[i] +=
                std::pow(relative_error(accumulators[i].radiance(), reference[i].radiance()), 2.0);
        }
    }
    for (size_t i = 0; i < positions.size(); ++i) {
        ratios.push_back(accumulators[i].standard_error() / std::sqrt(squares[i] / kSeeds));
    }
    std::ranges::nth_element(ratios, ratios.begin() + 20);
    EXPECT_GT(ratios[20], 0.8);
    EXPECT_LT(ratios[20], 1.25);
}

}  // namespace
}  // namespace tetralight
