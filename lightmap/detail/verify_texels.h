// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight::detail {

/// True for the scales that halves may have: powers of two within `kLargestLightmapScale`.
[[nodiscard]] bool is_lightmap_scale(float scale) noexcept;

/// Checks that halves are finite, and that irradiance, flux and errors are not negative. Returns
/// corrupt with the texel as field.
[[nodiscard]] Status check_texels(const LightmapsView& lightmaps);

}  // namespace tetralight::detail
