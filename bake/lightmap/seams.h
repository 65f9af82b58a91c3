// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// An edge of a surface in a page.
struct PageEdge {
    uint32_t page = 0;
    /// Its ends in texels: texel (x, y) covers [x, x + 1] × [y, y + 1].
    glm::vec2 begin{0.0f}, end{0.0f};

    bool operator==(const PageEdge&) const = default;
};

/// One edge of a smooth surface that lies at two places of the pages.
struct Seam {
    PageEdge first, second;            ///< in the same direction
    std::array<glm::dvec3, 2> ends{};  ///< of `first` in the world

    bool operator==(const Seam&) const = default;
};

struct SeamSettings {
    /// Largest distance between the ends of two edges, metres, for the same edge.
    double max_distance = 1e-4;
    /// Largest angle between the normals of both sides at the ends, for a smooth surface.
    double max_angle_degrees = 15.0;
};

/// The seams between charts of one instance, and between instances that form one surface, such as
/// the tiles of a floor. Edges count whose ends coincide: a long edge beside two short ones is not
/// found. Only instances that `joins` names, one an instance, have seams. In the order of instances
/// and triangles.
[[nodiscard]] std::vector<Seam> find_seams(const Scene& scene, const LightmapLayout& layout,
                                           const std::vector<bool>& joins,
                                           const SeamSettings& settings = {});

}  // namespace tetralight
