// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/position_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight::detail {
namespace {

using Node = PositionTree::Node;

/// The distances to the nearest of the others, ascending.
class Nearest {
  public:
    explicit Nearest(size_t count) : count_(count) {
        distances_.fill(std::numeric_limits<double>::infinity());
    }

    [[nodiscard]] double last() const { return distances_[count_ - 1]; }

    void add(double distance) {
        if (distance >= last()) return;
        size_t i = count_ - 1;
        for (; i > 0 && distances_[i - 1] > distance; --i) distances_[i] = distances_[i - 1];
        distances_[i] = distance;
    }

  private:
    std::array<double, PositionTree::kLeafSize - 1> distances_;
    size_t count_;
};

double distance_to(const Node& node, const glm::dvec3& p) {
    return glm::distance(glm::clamp(p, node.bounds.min, node.bounds.max), p);
}

/// Visits near nodes first, so that most of the far ones need not be entered.
class NearestSearch {
  public:
    NearestSearch(std::span<const Node> nodes, std::span<const glm::dvec3> positions,
                  uint32_t position)
        : nodes_(nodes),
          positions_(positions),
          position_(position),
          nearest_(PositionTree::spacing_rank(positions.size())) {}

    double run() {
        visit(0);
        return nearest_.last();
    }

  private:
    void visit(uint32_t number) {
        const Node& node = nodes_[number];
        const glm::dvec3& p = positions_[position_];
        if (node.is_leaf()) {
            for (uint32_t i = node.begin; i < node.end; ++i) {
                if (i != position_) nearest_.add(glm::distance(p, positions_[i]));
            }
            return;
        }
        uint32_t near = number + 1, far = node.second_child;
        double near_distance = distance_to(nodes_[near], p);
        double far_distance = distance_to(nodes_[far], p);
        if (far_distance < near_distance) {
            std::swap(near, far);
            std::swap(near_distance, far_distance);
        }
        if (near_distance < nearest_.last()) visit(near);
        if (far_distance < nearest_.last()) visit(far);
    }

    std::span<const Node> nodes_;
    std::span<const glm::dvec3> positions_;
    uint32_t position_;
    Nearest nearest_;
};

}  // namespace

PositionTree::PositionTree(std::span<const glm::dvec3> positions) : positions_(positions) {
    nodes_.reserve(2 * positions.size() / kLeafSize + 1);
    add_node(0, static_cast<uint32_t>(positions.size()));
}

void PositionTree::add_node(uint32_t begin, uint32_t end) {
    const auto number = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({{positions_[begin], positions_[begin]}, begin, end, 0});
    if (end - begin < 2 * kLeafSize) {
        for (uint32_t i = begin; i < end; ++i) {
            nodes_[number].bounds = union_of(nodes_[number].bounds, positions_[i]);
        }
        return;
    }
    const uint32_t middle = begin + (end - begin) / 2;
    add_node(begin, middle);
    const auto second = static_cast<uint32_t>(nodes_.size());
    add_node(middle, end);
    nodes_[number].second_child = second;
    nodes_[number].bounds = union_of(nodes_[number + 1].bounds, nodes_[second].bounds);
}

size_t PositionTree::spacing_rank(size_t position_count) {
    if (position_count >= kLeafSize) return kLeafSize - 1;
    return std::max<size_t>(1, position_count / 2);
}

double PositionTree::spacing(uint32_t position) const {
    return positions_.size() < 2 ? 0.0 : NearestSearch(nodes_, positions_, position).run();
}

double joint_diagonal(const PositionTree::Node& a, const PositionTree::Node& b) {
    return glm::length(union_of(a.bounds, b.bounds).size());
}

double gap(const PositionTree::Node& a, const PositionTree::Node& b) {
    return glm::length(
        glm::max(glm::max(a.bounds.min - b.bounds.max, b.bounds.min - a.bounds.max), 0.0));
}

}  // namespace tetralight::detail
