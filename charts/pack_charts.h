// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/charts/unwrap.h>

namespace tetralight {

struct PackSettings {
    float texels_per_meter = 10;  ///< finite, > 0
    uint32_t max_size = 1024;  ///< largest width and height of the rectangle, texels, in [4, 16384]
};

/// The charts of a mesh in a rectangle of texels.
struct PackedCharts {
    uint32_t width = 0;   ///< texels, margins included; 0 without triangles
    uint32_t height = 0;  ///< texels, margins included; 0 without triangles
    /// Three a triangle: texels from the corner of the rectangle. Texel (x, y) covers
    /// [x, x + 1] × [y, y + 1].
    std::vector<glm::vec2> corner_uvs;

    bool operator==(const PackedCharts&) const = default;
};

/// Packs charts into a small rectangle. The footprint of a chart is all texels that bilinear
/// filtering reads at some point of it (`for_each_touched_texel` with a margin of 0.5). Between the
/// footprints of two charts lie at least two free texels, and between a footprint and the border of
/// the rectangle at least one. So rectangles can lie side by side.
///
/// Charts move as a whole and are turned by 0 or 90 degrees, or not at all if their rotation is
/// `Fixed`. A chart smaller than a texel has a footprint of 2 × 2.
///
/// Returns invalid_argument, with `texels_per_meter` as field, if the charts need a rectangle
/// larger than `max_size`. The message gives the size and does not name the mesh.
[[nodiscard]] Result<PackedCharts> pack_charts(const Unwrap& charts, const PackSettings& settings);

}  // namespace tetralight
