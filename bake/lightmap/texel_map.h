// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// A point of a mesh.
struct ChartPoint {
    uint32_t triangle = 0;
    glm::vec2 barycentric{0.0f};  ///< weights of the second and third corner
};

/// What the texels of a packing cover. The same for all of its instances.
struct TexelMap {
    struct Texel {
        uint32_t index = 0;  ///< row · width + column
        /// A range of `points`: first that nearest to the middle of the texel, then the places
        /// inside the texel where light is sampled, or none.
        uint32_t first_point = 0;
        uint32_t point_count = 0;
    };

    uint32_t width = 0, height = 0;
    /// The chart whose bilinear footprint contains a texel, or kNoIndex.
    std::vector<uint32_t> charts;
    /// Texels that triangles with an area cover in part, by index. These are baked.
    std::vector<Texel> texels;
    std::vector<ChartPoint> points;

    [[nodiscard]] ChartPoint center(const Texel& texel) const { return points[texel.first_point]; }

    [[nodiscard]] std::span<const ChartPoint> samples(const Texel& texel) const {
        return std::span(points).subspan(texel.first_point + 1, texel.point_count - 1);
    }
};

/// Maps the texels of a packing to points of its mesh. `grid`² places of each texel are tried,
/// those on a triangle become samples. Points lie at least a fiftieth of a texel inside their
/// triangle, or as far as it is large: not on an edge, where another surface may begin.
[[nodiscard]] TexelMap make_texel_map(const Mesh& mesh, const LightmapPacking& packing,
                                      uint32_t grid);

}  // namespace tetralight
