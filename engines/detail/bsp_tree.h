// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace tetralight::detail {

/// A node of a tree of planes. A position is over the plane if dot(normal, position) > distance.
struct BspNode {
    glm::vec3 normal{0.0f};
    float distance = 0.0f;
    /// The index of a node, which is larger than that of this one, or −(tetrahedron + 1).
    int32_t over = 0;
    int32_t under = 0;

    bool operator==(const BspNode&) const = default;
};

struct BspTree {
    /// The first is the root.
    std::vector<BspNode> nodes;
    /// Nodes on the longest way to a leaf.
    uint32_t depth = 0;
};

/// Where a tree ends although its tetrahedra are not separated. Not reached by those of probes.
inline constexpr uint32_t kDeepestBsp = 256;

/// Planes that separate tetrahedra, all of them planes of their faces: a walk from the root ends at
/// the tetrahedron that holds the position. Positions outside of all of them, too, end at one.
/// About O(n log n). Precondition: there are tetrahedra; they do not overlap, and outward faces are
/// those of `kOutwardFaces`.
[[nodiscard]] BspTree make_bsp_tree(std::span<const glm::vec3> points,
                                    std::span<const std::array<uint32_t, 4>> tetrahedra);

/// The tetrahedron where the walk to a position ends, in floats as Godot walks.
[[nodiscard]] uint32_t find_tetrahedron(std::span<const BspNode> nodes, glm::vec3 position);

}  // namespace tetralight::detail
