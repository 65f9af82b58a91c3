// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/sensor_errors.h>

#include <cmath>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

double total_light(const LightPool& pool, std::span<const uint32_t> sensors) {
    double sum = 0.0;
    for (const uint32_t sensor : sensors) sum += mean_irradiance(pool.light(sensor));
    return sum;
}

/// Root of a mean square over the mean light.
double relative(double square_sum, double light_sum, size_t count) {
    if (!(light_sum > 0.0)) return 0.0;
    const auto n = static_cast<double>(count);
    return std::sqrt(square_sum / n) / (light_sum / n);
}

/// Sets the hidden corner; returns the mean square for light from visible corners only.
float visible_part(const ProbeVolume& volume, const TraceScene& traced, const glm::dvec3& position,
                   const IrradianceSh& light, const CellLocation& location, SensorError& error) {
    const Cell& cell = volume.cells[location.cell];
    const glm::vec3 here = traced.render_from_world(position);
    IrradianceSh seen;
    float weight = 0.0f, hidden = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[i];
        constexpr float kNothing = 1e-3f;
        if (probe == kNoIndex || location.weights[i] < kNothing) continue;
        const glm::vec3 there = traced.render_from_world(volume.exact_positions[probe]);
        if (there == here || is_visible(traced, here, there)) {
            seen += location.weights[i] * volume.irradiance[probe];
            weight += location.weights[i];
        } else if (location.weights[i] > hidden) {
            hidden = location.weights[i];
            error.hidden_probe = probe;
        }
    }
    if (weight == 0.0f) return error.square;
    return static_cast<float>(mean_square((1.0f / weight) * seen + -1.0f * light));
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

std::vector<SensorError> sensor_errors(const ProbeVolume& volume, const LightPool& pool,
                                       std::span<const uint32_t> sensors, const TraceScene* traced,
                                       uint32_t thread_count) {
    std::vector<glm::vec3> positions;
    for (const uint32_t sensor : sensors) positions.emplace_back(pool.position(sensor));
    const ProbeVolumeView view = volume.view();
    std::vector<SensorError> errors(sensors.size());
    const auto look = [&](size_t i) {
        const CellLocation location = locate(view, positions[i]);
        const IrradianceSh& light = pool.light(sensors[i]);
        SensorError& error = errors[i];
        const IrradianceSh difference = interpolate(view, location).irradiance + -1.0f * light;
        error.cell = location.cell;
        error.square = static_cast<float>(mean_square(difference));
        error.visible_square = error.square;
        if (traced == nullptr || location.cell == kNoIndex) return;
        error.visible_square =
            visible_part(volume, *traced, pool.position(sensors[i]), light, location, error);
    };
    // The caller computes many small sets in parallel, so that each runs on one thread.
    if (traced == nullptr && sensors.size() < 4096) {
        for (size_t i = 0; i < sensors.size(); ++i) look(i);
    } else {
        parallel_for(sensors.size(), thread_count, look);
    }
    return errors;
}

double relative_error(std::span<const SensorError> errors, const LightPool& pool,
                      std::span<const uint32_t> sensors) {
    double sum = 0.0;
    for (const SensorError& error : errors) sum += double{error.square};
    return relative(sum, total_light(pool, sensors), sensors.size());
}

double relative_noise(const LightPool& pool, std::span<const uint32_t> sensors) {
    double sum = 0.0;
    for (const uint32_t sensor : sensors) {
        const auto noise = static_cast<double>(pool.standard_error(sensor));
        sum += noise * noise * mean_square(pool.light(sensor));
    }
    return relative(sum, total_light(pool, sensors), sensors.size());
}

}  // namespace tetralight
