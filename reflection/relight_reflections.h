// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/reflection/reflections.h>

// Light that can change after the bake, as probes/recombine.h does it for probes:
//
//     auto status = relight_reflections(reflections, {{"lamp", 0.0f}, {"neon", 2.0f}});

namespace tetralight {

/// Sets weights of some layers, by their name or the part after its colon, and rewrites the levels
/// and the irradiance of the probes: Σ w_k · layer_k. Texels are rounded to the nearest half; light
/// above the largest half becomes that one. Returns the share of the light of level 0 that this
/// takes away, in [0, 1].
///
/// Returns not_found if no layer has a name (the message lists the layers), and invalid_argument if
/// several have it, or if a weight is negative, not finite or given twice. Nothing is changed then.
/// Precondition: `verify` finds no error.
[[nodiscard]] Result<double> relight_reflections(Reflections& reflections,
                                                 std::span<const LayerWeight> changes);

}  // namespace tetralight
