// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/pipeline/dering_probes.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_volume.h>

// From what a bake split light into to the layers, transfer and occlusion of a volume.

namespace tetralight {

/// The parts that a volume without light asks for: its layers but for "rest", a transfer where it
/// has a sky, occlusion where it has lights of it.
[[nodiscard]] LightGroupLayout split_layout(const ProbeVolumeView& volume) noexcept;

/// Fills layers (but for "rest"), transfer and occlusion from `rows`, one a accumulator.
/// Precondition: rows of `split_layout(volume)`.
void store_split(std::span<const ProbeAccumulator> accumulators, std::span<const double> rows,
                 ProbeVolume& volume);

/// Fills "rest", where there is one, with what the other layers leave of the light: their sum with
/// it last then has the bits of the whole, or differs by the rounding of one addition.
void store_rest(ProbeVolume& volume);

/// Removes ringing from each layer of the probes that ask for it, so that every sum with weights
/// that are not negative has none.
void dering_layers(const std::vector<bool>& is_dering_asked_for, DeringWindow window,
                   ProbeVolume& volume);

/// Makes the light of the volume the sum of its layers, where it has some.
void sum_layers(ProbeVolume& volume);

}  // namespace tetralight
