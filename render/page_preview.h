// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/exported_texels.h>

namespace tetralight {

/// Which instances with a lightmap have one of these names.
[[nodiscard]] std::vector<bool> instances_named(const LightmapsView& lightmaps,
                                                const std::vector<std::string>& names);

/// A page for looking at, v = 0 at the top, on grey where no surface is: its values, exposed and
/// tone-mapped by themselves unless they are fractions. Each rectangle has a blue border of one
/// texel, those of marked instances
/// (`is_marked`, one a rectangle) an orange one of three; all others are then dimmed.
/// Precondition: the page exists; the values are those of the lightmaps.
[[nodiscard]] Image8 page_preview(const LightmapsView& lightmaps, const ExportedTexels& values,
                                  uint32_t page, const std::vector<bool>& is_marked);

}  // namespace tetralight
