// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>

// Error bars of each layer. They are those of the sum (`ProbeAccumulator::sampling_error`) for the
// light of one layer; the layer after the last is the rest, the sum minus all layers. Light that a
// limit of bounces cuts is not part of them.

namespace tetralight {

/// Adds the variances of a round to a row. `row` has the size of the layout.
void add_layer_variances(const LightGroupLayout& layout, std::span<const ProbeEstimate> estimates,
                         std::span<double> row, ErrorMeasure measure = ErrorMeasure::AllNormals);

/// Relative standard error of the irradiance of each layer, root mean square over all normals and
/// channels; 0 if it is unknown or no light of the layer arrives. `row` belongs to `accumulator`.
[[nodiscard]] std::vector<float> layer_errors(const LightGroupLayout& layout,
                                              const ProbeAccumulator& accumulator,
                                              std::span<const double> row,
                                              ErrorMeasure measure = ErrorMeasure::AllNormals);

/// The largest error of a layer at a probe. Errors are relative to the light of the layer there, or
/// to a hundredth of `mean_light` of the layer where that is more, so that places which a layer
/// hardly lights need no more samples than others.
[[nodiscard]] float worst_layer_error(const LightGroupLayout& layout,
                                      const ProbeAccumulator& accumulator,
                                      std::span<const double> row,
                                      std::span<const double> mean_light,
                                      ErrorMeasure measure = ErrorMeasure::AllNormals);

/// The mean light of each layer over 64 random places in the bounds of the scene that are not
/// inside geometry: √(Σ A_l² L_i²), 128 samples a place. A function of the scene, the plan and the
/// seed alone; takes about as long as eight probes of 1024 samples. All 0 if the scene is empty.
[[nodiscard]] std::vector<double> mean_layer_light(const Scene& scene, const PathTracer& tracer,
                                                   uint64_t seed, uint32_t thread_count);

}  // namespace tetralight
