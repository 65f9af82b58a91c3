// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include <tetralight/charts/unwrap.h>

namespace tetralight {

/// What is known about the UVs that come with a mesh.
struct UvCheck {
    double overlap_area = 0.0;   ///< area of UV space in more than one triangle
    double area = 0.0;           ///< sum of the areas of the triangles in UV space
    double lost_fraction = 0.0;  ///< part of the surface that has no area in UV space to speak of
    uint32_t outside_count = 0;  ///< corners outside [0, 1] by more than 1e-4, or not finite

    bool operator==(const UvCheck&) const = default;
};

/// Checks if UVs can hold a lightmap: `uvs` has one for each position of the mesh.
///
/// The overlap is counted on 2048 × 2048 samples of the bounding rectangle of the UVs. Its error is
/// about its perimeter times half the distance of samples, and overlaps narrower than that distance
/// may be missed. Triangles that share an edge do not overlap. Triangles with a UV that is not
/// finite do not count. A surface is lost if its share of the UV area is below a millionth of its
/// share of the surface: a texel would be a thousand times as long there as elsewhere.
/// Preconditions: those of `unwrap`; as many UVs as positions.
[[nodiscard]] UvCheck check_uvs(const ChartMesh& mesh, std::span<const glm::vec2> uvs);

/// Makes one chart of the UVs that come with a mesh. U and V are scaled so that a step along each
/// is equally long on the surface, on average, and the sum of the areas of the triangles in the
/// chart is the area of the surface. The chart has `ChartRotation::Fixed`. All its
/// UVs are 0 if the UVs of the mesh or its surface have no area.
/// Preconditions: those of `check_uvs`; finite UVs.
[[nodiscard]] Unwrap keep_uvs(const ChartMesh& mesh, std::span<const glm::vec2> uvs);

}  // namespace tetralight
