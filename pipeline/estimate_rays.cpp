// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/estimate_rays.h>

#include <algorithm>

#include <tetralight/bake/layer_errors.h>
#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/base/stopwatch.h>

namespace tetralight {
namespace {

/// Of all places, an eighth is sampled, but not fewer or more than these.
constexpr size_t kFewest = 128;
constexpr size_t kMost = 1024;
constexpr size_t kShare = 8;
/// Samples of a sampled place: with fewer, light that is seldom found is not known of.
constexpr uint32_t kFirstSamples = 1024;

/// The sampled places: the middles of equal pieces of all places.
std::vector<size_t> spread_indices(size_t count) {
    const size_t sampled = std::min(count, std::clamp(count / kShare, kFewest, kMost));
    std::vector<size_t> indices;
    for (size_t i = 0; i < sampled; ++i) indices.push_back((2 * i + 1) * count / (2 * sampled));
    return indices;
}

template <class T>
std::vector<T> pick(std::span<const T> all, std::span<const size_t> indices) {
    std::vector<T> picked;
    if (all.empty()) return picked;
    for (const size_t i : indices) picked.push_back(all[i]);
    return picked;
}

/// One round of few samples.
BakeSettings first_round(BakeSettings settings) {
    settings.time_budget_seconds = 0.0;
    settings.sample_count = std::min(settings.sample_count, kFirstSamples);
    settings.max_sample_count = RoundPlan::first_round_samples(settings);
    return settings;
}

/// Samples that a place is expected to have when it is done. All have the first round, which may be
/// larger than what was sampled. `worst_layer`: the error of its worst layer, if it has a target.
uint64_t expected_samples(const RoundPlan& plan, const ProbeAccumulator& accumulator,
                          float worst_layer) {
    if (!plan.has_target()) return plan.max_samples();
    return std::max(plan.samples_before(1), plan.expected_samples(accumulator, worst_layer));
}

}  // namespace

Result<RayEstimate> estimate_rays(const Scene& scene, const BakePlaces& places,
                                  const BakeSettings& settings,
                                  std::span<const OcclusionLights> occlusion_lights,
                                  const BakeCallback& callback) {
    const std::vector<size_t> indices = spread_indices(places.positions.size());
    if (indices.empty()) return RayEstimate{};
    const auto positions = pick(places.positions, indices);
    const auto texels = pick(places.surfaces.texels, indices);
    const auto lights = pick(occlusion_lights, indices);
    const LightGroupLayout layout(settings.plan);
    std::vector<ProbeAccumulator> accumulators(indices.size());
    std::vector<double> rows(indices.size() * layout.size());
    const Stopwatch watch;
    const auto status = bake_accumulators(scene, {positions, {texels, places.surfaces.origins}},
                                          first_round(settings), accumulators,
                                          {.progress = callback}, {rows, lights});
    if (!status) return status.error();
    const double seconds = watch.seconds();

    const RoundPlan plan(settings, places.measure());
    double expected = 0.0;
    uint64_t traced = 0;
    for (size_t i = 0; i < indices.size(); ++i) {
        const ProbeAccumulator& accumulator = accumulators[i];
        const auto row = std::span(rows).subspan(i * layout.size(), layout.size());
        const std::vector<float> errors =
            plan.has_layer_target() ? layer_errors(layout, accumulator, row) : std::vector<float>{};
        const float worst = errors.empty() ? 0.0f : *std::ranges::max_element(errors);
        expected += static_cast<double>(expected_samples(plan, accumulator, worst)) *
                    static_cast<double>(accumulator.ray_count) /
                    static_cast<double>(accumulator.sample_count);
        traced += accumulator.ray_count;
    }
    const double share =
        static_cast<double>(places.positions.size()) / static_cast<double>(indices.size());
    return RayEstimate{share * expected, static_cast<double>(traced) / std::max(seconds, 1e-9)};
}

}  // namespace tetralight
