// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight::detail {

/// Checks that each rectangle lies inside its page, has the scale and offset of its texels and
/// names a mesh, and that no two rectangles of a page overlap. Returns corrupt with the rectangle
/// as field. Cost: O(n log n).
[[nodiscard]] Status check_rectangles(const LightmapsView& lightmaps);

}  // namespace tetralight::detail
