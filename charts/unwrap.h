// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight {

// Unwrapping gives each surface point of a mesh a place of its own in a texture:
//
//     triangles → unwrap → charts, in metres → pack_charts → a rectangle of texels → pack_pages
//
//     const Unwrap charts = unwrap({positions, indices});
//     const Result<PackedCharts> rectangle = pack_charts(charts, {.texels_per_meter = 10});

/// Triangles to unwrap. Positions are finite and in metres.
struct ChartMesh {
    std::span<const glm::vec3> positions;
    std::span<const uint32_t> indices;  ///< three a triangle, counterclockwise seen from the front
};

struct UnwrapSettings {
    /// Largest angle between a triangle's normal and the direction in which its chart is
    /// projected. Larger angles give fewer charts and more stretch: lengths shrink by at most the
    /// cosine. From 45 on, one chart can span two faces of a box. In (0, 89].
    float max_angle_degrees = 42;
};

/// What packing may do with the charts of an unwrap.
enum class ChartRotation : uint8_t {
    Free,   ///< turn each by 0 or 90 degrees
    Fixed,  ///< keep them as they are
};

/// The charts of a mesh: parts of its surface, each flattened into a plane. No two triangles of a
/// chart from `unwrap` overlap, and none is mirrored.
struct Unwrap {
    /// Three a triangle: metres in the plane of its chart. The smallest u and v of a chart are 0.
    std::vector<glm::vec2> corner_uvs;
    std::vector<uint32_t> triangle_charts;  ///< chart of each triangle
    std::vector<glm::vec2> chart_sizes;     ///< largest u and v of each chart, metres
    ChartRotation rotation = ChartRotation::Free;

    bool operator==(const Unwrap&) const = default;
};

/// Cuts a mesh into charts, each projected along one direction, so that a triangle at the angle θ
/// to that direction keeps the share cos θ of its area. Charts grow over edges between equal
/// positions, and stop where surfaces turn by more than the largest angle or would overlap. Each
/// is turned to its smallest bounding rectangle. A triangle without area goes with a neighbor, or
/// becomes a chart of its own if it has none.
///
/// The result depends on the arguments alone, and not on the position of the mesh as long as
/// differences of positions are the same. Coordinates may be as large as 1e30.
/// Preconditions: a multiple of three indices, each of a position; finite positions.
[[nodiscard]] Unwrap unwrap(const ChartMesh& mesh, const UnwrapSettings& settings = {});

}  // namespace tetralight
