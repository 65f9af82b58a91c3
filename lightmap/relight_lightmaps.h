// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/probes/recombine.h>

// Light that can change after the bake, as probes/recombine.h does it for probes:
//
//     auto status = relight_lightmaps(lightmaps, {{"lamp", 0.0f}, {"neon", 2.0f}});

namespace tetralight {

/// Sets weights of some layers, by their name or the part after its colon, and rewrites
/// `irradiance` and `light`: each value becomes rest + Σ w_k · layer_k, where rest = value − Σ w_k
/// · layer_k with the weights before is the light that is in no layer. A rest within the rounding
/// of halves counts as 0, so that no light remains of layers that are switched off, and errors do
/// not add up over many calls. Irradiance and flux are at least 0, and all values are rounded to
/// the nearest half: relative error 2^-11 of each. `info.scale` grows if the light exceeds it.
/// Weights that do not change leave the texels as they are.
///
/// `light` is removed if there is no `layer_light`. `error` remains that of the bake.
///
/// Returns not_found if no layer has a name (the message lists the layers), invalid_argument if
/// several have it, if a weight is negative, not finite, given twice or so large that halves cannot
/// hold the light, and corrupt if `layer_irradiance` does not have one texel for each layer and
/// texel. The lightmaps are not changed then.
[[nodiscard]] Status relight_lightmaps(Lightmaps& lightmaps, std::span<const LayerWeight> changes);

}  // namespace tetralight
