// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_error.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/base/error_text.h>
#include <tetralight/bench/grid_places.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::bench {
namespace {

double total_light(const std::vector<IrradianceSh>& light) {
    double sum = 0.0;
    for (const IrradianceSh& l : light) sum += mean_irradiance(l);
    return sum;
}

/// The root of the mean of squares, relative to the mean irradiance.
double relative(double square_sum, const std::vector<IrradianceSh>& light) {
    const auto n = static_cast<double>(light.size());
    return std::sqrt(square_sum / n) / (total_light(light) / n);
}

}  // namespace

LightReference bake_reference(const Scene& scene, std::span<const glm::dvec3> positions,
                              uint32_t sample_count) {
    BakeSettings settings;
    settings.sample_count = sample_count;
    settings.seed = 77;
    const auto baked = bake_probes(scene, positions, settings);
    require(bool(baked), "bake");
    LightReference reference;
    double noise = 0.0;
    for (size_t i = 0; i < positions.size(); ++i) {
        reference.positions.emplace_back(positions[i]);
        reference.light.push_back(irradiance_from_radiance(baked->radiance[i]));
        const auto relative_error = static_cast<double>(baked->standard_error[i]);
        noise += relative_error * relative_error * mean_square(reference.light.back());
    }
    reference.noise = relative(noise, reference.light);
    return reference;
}

LightReference make_reference(const GridSubject& subject, size_t count, uint32_t sample_count) {
    constexpr int kMostRounds = 8;
    ReachablePlaces places(subject);
    LightReference reference;
    double squares = 0.0;  // of the noise
    for (int round = 0; round < kMostRounds && reference.light.size() < count; ++round) {
        const LightReference some = bake_reference(
            subject.scene, places.next(count - reference.light.size()), sample_count);
        for (size_t i = 0; i < some.light.size(); ++i) {
            if (!(mean_irradiance(some.light[i]) > 0.0)) continue;
            reference.positions.push_back(some.positions[i]);
            reference.light.push_back(some.light[i]);
        }
        // Places without light have no noise, so that this sum is that of the others.
        const double noise = some.noise * total_light(some.light);
        squares += noise * noise / static_cast<double>(some.light.size());
    }
    require(!reference.light.empty(), "places that light reaches");
    reference.noise = relative(squares, reference.light);
    return reference;
}

LightErrors light_errors(const LightReference& reference, std::span<const IrradianceSh> answers) {
    require(answers.size() == reference.light.size(), "one answer a position");
    std::vector<double> errors, fractions;
    double squares = 0.0, sum = 0.0;
    for (size_t i = 0; i < answers.size(); ++i) {
        const double square = mean_square(answers[i] + -1.0f * reference.light[i]);
        squares += square;
        errors.push_back(std::sqrt(square));
        fractions.push_back(std::sqrt(square / mean_square(reference.light[i])));
        sum += errors.back();
    }
    const double light = total_light(reference.light);
    const double rms = relative(squares, reference.light);
    std::ranges::sort(errors);
    LightErrors all;
    all.rms = std::sqrt(std::max(0.0, rms * rms - reference.noise * reference.noise));
    all.mean = sum / light;
    all.p95 = errors[errors.size() * 95 / 100] * static_cast<double>(errors.size()) / light;
    all.relative = median(std::move(fractions));
    return all;
}

double light_error(const LightReference& reference, std::span<const IrradianceSh> answers) {
    return light_errors(reference, answers).rms;
}

BakedVolume bake_grid(const GridSubject& subject, const ProbeGrid& grid, uint32_t sample_count) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = sample_count;
    auto baked = bake_volume(subject.scene, grid.groups, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    return std::move(*baked);
}

LightErrors light_errors(const ProbeVolumeView& volume, const LightReference& reference) {
    std::vector<IrradianceSh> answers(reference.positions.size());
    const InterpolationBatch batch{.positions = reference.positions, .irradiance = answers};
    require(bool(interpolate(volume.without_compact(), batch)), "batch");
    return light_errors(reference, answers);
}

ProbeGrid spaced_grid(const GridSubject& subject, double spacing) {
    ProbeGridSettings settings;
    settings.bounds = subject.bounds;
    settings.from = subject.from;
    settings.spacing = glm::dvec3(spacing);
    auto grid = make_probe_grid(subject.scene, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

ProbeGrid regular_grid(const GridSubject& subject, uint64_t probe_count) {
    const glm::dvec3 size = subject.bounds.size();
    double low = 0.0, high = 2.0 * std::max({size.x, size.y, size.z});
    double spacing = std::cbrt(size.x * size.y * size.z / static_cast<double>(probe_count));
    ProbeGrid best;
    for (int i = 0; i < 12; ++i) {
        ProbeGrid grid = spaced_grid(subject, spacing);
        const auto off = [&](const ProbeGrid& g) {
            return std::abs(static_cast<double>(g.probe_count()) -
                            static_cast<double>(probe_count));
        };
        (grid.probe_count() > probe_count ? low : high) = spacing;
        if (best.groups.empty() || off(grid) < off(best)) best = std::move(grid);
        if (off(best) < 0.01 * static_cast<double>(probe_count)) break;
        const double found = static_cast<double>(std::max<uint64_t>(best.probe_count(), 1));
        const double guess = i < 3 ? spacing * std::cbrt(found / static_cast<double>(probe_count))
                                   : 0.5 * (low + high);
        spacing = guess > low && guess < high ? guess : 0.5 * (low + high);
    }
    return best;
}

ProbeGrid adaptive_grid(const GridSubject& subject, uint64_t probe_count) {
    ProbeGridSettings settings;
    settings.mode = PlacementMode::Adaptive;
    settings.bounds = subject.bounds;
    settings.from = subject.from;
    settings.max_probes = probe_count;
    settings.adaptive.target_error = 1e-4;  // not reached, so that all probes are used
    auto grid = make_probe_grid(subject.scene, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

}  // namespace tetralight::bench
