// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/pipeline/dering_probes.h>
#include <tetralight/pipeline/place_range.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_volume.h>

// Layers, transfer and occlusion of a volume from the light groups of a bake.

namespace tetralight {

/// The light groups of a prepared volume: its layers but for "rest", transfer if it has a sky,
/// occlusion if it has occlusion lights.
[[nodiscard]] LightGroupLayout split_layout(const ProbeVolumeView& volume) noexcept;

/// Fills layers (but for "rest"), the errors of all layers, transfer and occlusion of the probes of
/// a range from `rows`, one an accumulator.
/// Precondition: rows of `split_layout(volume)`.
void store_split(const PlaceRange& range, std::span<const ProbeAccumulator> accumulators,
                 std::span<const double> rows, ProbeVolume& volume);

/// Fills layer "rest", if there is one, with the total minus all other layers: the sum of all
/// layers in order then has the bits of the total, or differs by the rounding of one addition.
void store_rest(ProbeVolume& volume);

/// Removes ringing from each layer of the given probes, so that no sum of layers with weights ≥ 0
/// rings.
void dering_layers(const std::vector<bool>& is_dering_asked_for, DeringWindow window,
                   ProbeVolume& volume);

/// Sets the light of the volume to the sum of its layers, if it has layers.
void sum_layers(ProbeVolume& volume);

}  // namespace tetralight
