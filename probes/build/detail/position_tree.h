// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/box.h>

namespace tetralight::detail {

/// A binary tree of bounding boxes over positions along a Hilbert curve. It needs no cell size, so
/// it suits sets whose spacing differs by any factor from place to place.
class PositionTree {
  public:
    struct Node {
        Box<glm::dvec3> bounds;
        uint32_t begin = 0;  ///< of the positions in it
        uint32_t end = 0;
        uint32_t second_child = 0;  ///< the first one follows its parent; 0 = a leaf

        [[nodiscard]] bool is_leaf() const { return second_child == 0; }

        [[nodiscard]] uint32_t size() const { return end - begin; }
    };

    /// A leaf has at least so many positions, and fewer than twice as many, unless all are fewer.
    static constexpr uint32_t kLeafSize = 8;

    /// Precondition: at least one position; they outlive the tree.
    explicit PositionTree(std::span<const glm::dvec3> positions);

    /// Parents come before their children; the first one is the root.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

    /// The rank of the neighbor whose distance is the spacing, counted from the nearest as 1: the
    /// seventh. With fewer than eight positions the median, because the farthest may be far from
    /// all others.
    [[nodiscard]] static size_t spacing_rank(size_t position_count);

    /// The distance of that neighbor from a position. 0 for a single position.
    [[nodiscard]] double spacing(uint32_t position) const;

  private:
    void add_node(uint32_t begin, uint32_t end);

    std::span<const glm::dvec3> positions_;
    std::vector<Node> nodes_;
};

/// The diagonal of the union of the bounds of two nodes.
[[nodiscard]] double joint_diagonal(const PositionTree::Node& a, const PositionTree::Node& b);

/// The distance between the bounds of two nodes.
[[nodiscard]] double gap(const PositionTree::Node& a, const PositionTree::Node& b);

}  // namespace tetralight::detail
