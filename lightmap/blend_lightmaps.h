// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight {

/// The light between two scenarios (day and night, doors open and closed) that were baked with the
/// same pages and rectangles: (1 − t) · a + t · b, for 0 ≤ t ≤ 1, rounded to the nearest half. t =
/// 0 and t = 1 give the bytes of the light of `a` and `b`. All else is that of `a`, but the blend
/// has no layers and no `error`: relight before blending.
///
/// Returns invalid_argument if t is out of range, if pages, rectangles, meshes or mixed lighting
/// differ, or if only one of them has `light`. Precondition: both pass `verify`.
[[nodiscard]] Result<Lightmaps> blend_lightmaps(const LightmapsView& a, const LightmapsView& b,
                                                float t);

}  // namespace tetralight
