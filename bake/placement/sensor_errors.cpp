// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/sensor_errors.h>

#include <algorithm>
#include <cmath>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/coverage.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>

namespace tetralight {
namespace {

/// The light of the corners that see a position.
struct SeenLight {
    IrradianceSh sum;
    float weight = 0.0f;
};

SeenLight seen_light(const ProbeVolume& volume, std::span<const uint32_t> probes, uint32_t sensor,
                     const CellLocation& location, Sights& sights) {
    SeenLight seen;
    const Cell& cell = volume.cells[location.cell];
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
        const float weight = location.weights[i];
        if (probe == kNoIndex || !(weight > 0.0f)) continue;
        if (!sights.sees(probes[probe], sensor)) continue;
        seen.sum += weight * volume.irradiance[probe];
        seen.weight += weight;
    }
    return seen;
}

}  // namespace

ProbeVolume volume_of(const LightPool& pool, std::span<const uint32_t> probes) {
    MergedProbes merged;
    for (const uint32_t probe : probes) merged.positions.push_back(pool.position(probe));
    ProbeVolume volume = make_probe_volume(merged);
    // Positions are not snapped here: probes on a face of the hull make cells without volume, and
    // walks must come from inside to find them. From seeds they begin at probes.
    volume.seed_grid.clear();
    make_seeds(volume);
    for (const uint32_t probe : probes) volume.irradiance.push_back(pool.light(probe));
    return volume;
}

std::vector<SensorError> sensor_errors(const ProbeVolume& volume, std::span<const uint32_t> probes,
                                       std::span<const uint32_t> sensors, const SensorView& view,
                                       uint32_t thread_count) {
    const ProbeVolumeView probe_view = volume.view();
    std::vector<SensorError> errors(sensors.size());
    const auto look = [&](size_t i) {
        const CellLocation location = locate(probe_view, glm::vec3(view.pool.position(sensors[i])));
        SensorError& error = errors[i];
        error.is_covered = !view.is_to_cover[sensors[i]];
        error.cell = location.cell;
        SeenLight seen;
        if (location.cell != kNoIndex) {
            seen = seen_light(volume, probes, sensors[i], location, view.sights);
            const glm::dvec3& place = view.pool.position(sensors[i]);
            const bool is_inside = !is_in_hull_cell(probe_view, location, place) &&
                                   !is_off_flat_cell(probe_view, location, place);
            error.is_covered |= is_inside && seen.weight >= kMinSeenWeight;
        }
        constexpr float kNothing = 1e-3f;
        const IrradianceSh answer = seen.weight > kNothing
                                        ? (1.0f / seen.weight) * seen.sum
                                        : interpolate(probe_view, location).irradiance;
        const IrradianceSh& light = view.pool.light(sensors[i]);
        error.square = static_cast<float>(view.scale.square(answer + -1.0f * light, light));
    };
    // The caller computes many small sets in parallel, so that each runs on one thread.
    if (thread_count == 1) {
        for (size_t i = 0; i < sensors.size(); ++i) look(i);
    } else {
        parallel_for(sensors.size(), thread_count, look);
    }
    return errors;
}

double sum_of_costs(std::span<const SensorError> errors) {
    double sum = 0.0;
    for (const SensorError& error : errors) sum += error.cost();
    return sum;
}

size_t uncovered_count(std::span<const SensorError> errors) {
    return static_cast<size_t>(std::ranges::count(errors, false, &SensorError::is_covered));
}

double mean_error(std::span<const SensorError> errors) {
    double sum = 0.0;
    for (const SensorError& error : errors) sum += double{error.square};
    return errors.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

double noise_square(const LightPool& pool, uint32_t sensor, const ErrorScale& scale) {
    const auto noise = static_cast<double>(pool.standard_error(sensor));
    return noise * noise * scale.square(pool.light(sensor), pool.light(sensor));
}

double mean_noise(const LightPool& pool, std::span<const uint32_t> sensors,
                  const ErrorScale& scale) {
    double sum = 0.0;
    for (const uint32_t sensor : sensors) sum += noise_square(pool, sensor, scale);
    return sensors.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(sensors.size()));
}

}  // namespace tetralight
