// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/render/gizmos.h>

namespace tetralight {

/// The seams of lightmaps (`find_seams`) in three groups, by the largest difference of light
/// between their sides: up to 1 % teal, up to 10 % yellow, more red. Differences are those of
/// luminance relative to the mean of both sides, or to a hundredth of the mean of all seams where
/// that is more. Precondition: the lightmaps are those of the scene (`check_lightmap_scene`).
[[nodiscard]] std::vector<GizmoLines> make_seam_lines(const Scene& scene,
                                                      const LightmapsView& lightmaps);

}  // namespace tetralight
