// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/weld.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include <tetralight/probes/build/detail/local_origin.h>
#include <tetralight/probes/build/detail/position_tree.h>

namespace tetralight::detail {
namespace {

/// Positions nearer to each other than this are one: squares of such lengths leave the floats.
constexpr double kNearest = 1e-15;

/// A few steps of a float, relative to its value: nearer positions cannot be distinguished.
constexpr double kFloatSteps = 4e-7;

/// An upper bound of the spacing: in an open field duplicates are no farther apart than in a house.
constexpr double kLargestSpacing = 10.0;

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Clusters as trees whose root is always their lexicographically smallest position.
class Clusters {
  public:
    explicit Clusters(std::span<const glm::dvec3> positions)
        : positions_(positions), parents_(positions.size()) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    uint32_t root(uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }

    bool are_joined(uint32_t a, uint32_t b) { return root(a) == root(b); }

    void join(uint32_t a, uint32_t b) {
        a = root(a);
        b = root(b);
        if (is_before(positions_[b], positions_[a])) std::swap(a, b);
        parents_[b] = a;
    }

  private:
    std::span<const glm::dvec3> positions_;
    std::vector<uint32_t> parents_;
};

/// Compares the nodes of a tree with each other and skips pairs that are too far apart to hold near
/// positions, or that are one cluster already.
class Welder {
  public:
    Welder(std::span<const glm::dvec3> positions, double tolerance)
        : positions_(positions),
          tolerance_(tolerance),
          origin_(local_origin(positions)),
          tree_(positions),
          nodes_(tree_.nodes()),
          reaches_(nodes_.size()),
          radii_(positions.size()),
          has_exact_radius_(positions.size(), false),
          clusters_(positions) {
        for (size_t node = nodes_.size(); node-- > 0;) measure(node);
    }

    Weld run() {
        join_within(0);
        Weld result{{}, std::ranges::min(radii_)};
        for (uint32_t i = 0; i < positions_.size(); ++i) {
            result.representatives.push_back(clusters_.root(i));
        }
        return result;
    }

  private:
    using Node = PositionTree::Node;

    struct Reach {
        double largest = 0.0;         ///< no radius in the node is larger
        double smallest = 0.0;        ///< none is smaller
        bool is_one_cluster = false;  ///< known to be
    };

    /// First estimates: the other positions of a leaf are no farther than its diagonal.
    void measure(size_t number) {
        const Node& node = nodes_[number];
        Reach& reach = reaches_[number];
        if (!node.is_leaf()) {
            const Reach &a = reaches_[number + 1], &b = reaches_[node.second_child];
            reach = {std::max(a.largest, b.largest), std::min(a.smallest, b.smallest)};
            return;
        }
        const double largest = radius_at(joint_diagonal(node, node));
        reach.smallest = smallest_radius(node.begin);
        for (uint32_t i = node.begin; i < node.end; ++i) {
            const double smallest = smallest_radius(i);
            radii_[i] = std::max(smallest, largest);
            has_exact_radius_[i] = largest <= smallest;
            reach.smallest = std::min(reach.smallest, smallest);
            reach.largest = std::max(reach.largest, radii_[i]);
        }
    }

    [[nodiscard]] double radius_at(double spacing) const {
        return tolerance_ * std::min(spacing, kLargestSpacing);
    }

    [[nodiscard]] double smallest_radius(uint32_t i) const {
        return std::max(kNearest, kFloatSteps * glm::distance(positions_[i], origin_));
    }

    /// Few positions have others near enough to need their exact radius.
    double exact_radius(uint32_t i) {
        if (!has_exact_radius_[i]) {
            const double smallest = smallest_radius(i);
            radii_[i] = std::max(smallest, radius_at(tree_.spacing(i)));
            has_exact_radius_[i] = true;
        }
        return radii_[i];
    }

    void join_within(uint32_t number) {
        const Node& node = nodes_[number];
        if (node.is_leaf()) {
            const double reach = reaches_[number].largest;
            for (uint32_t i = node.begin; i < node.end; ++i) join_near(i, {i + 1, node.end}, reach);
        } else {
            join_within(number + 1);
            join_within(node.second_child);
            join_between(number + 1, node.second_child);
        }
        reaches_[number].is_one_cluster = is_one_cluster(number);
    }

    bool is_one_cluster(uint32_t number) {
        const Node& node = nodes_[number];
        if (!node.is_leaf()) {
            return reaches_[number + 1].is_one_cluster &&
                   reaches_[node.second_child].is_one_cluster &&
                   clusters_.are_joined(node.begin, node.end - 1);
        }
        uint32_t joined = node.begin + 1;
        while (joined < node.end && clusters_.are_joined(node.begin, joined)) ++joined;
        return joined == node.end;
    }

    void join_between(uint32_t a, uint32_t b) {
        const Node &first = nodes_[a], &second = nodes_[b];
        const Reach &r = reaches_[a], &s = reaches_[b];
        if (gap(first, second) > std::min(r.largest, s.largest)) return;
        if (r.is_one_cluster && s.is_one_cluster) {
            if (clusters_.are_joined(first.begin, second.begin)) return;
            if (joint_diagonal(first, second) <= std::min(r.smallest, s.smallest)) {
                return clusters_.join(first.begin, second.begin);
            }
        }
        if (first.is_leaf() && second.is_leaf()) {
            const double reach = std::min(r.largest, s.largest);
            for (uint32_t i = first.begin; i < first.end; ++i) {
                join_near(i, {second.begin, second.end}, reach);
            }
        } else if (second.is_leaf() || (!first.is_leaf() && first.size() > second.size())) {
            join_between(a + 1, b);
            join_between(first.second_child, b);
        } else {
            join_between(a, b + 1);
            join_between(a, second.second_child);
        }
    }

    struct Range {
        uint32_t begin;
        uint32_t end;
    };

    /// Joins a position with those of a range that are near. No radius that counts is above
    /// `reach`.
    void join_near(uint32_t i, Range range, double reach) {
        const glm::dvec3 position = positions_[i];
        for (uint32_t j = range.begin; j < range.end; ++j) {
            const glm::dvec3 offset = positions_[j] - position;
            const double square = glm::dot(offset, offset);
            if (square <= reach * reach) join_if_near(i, j, std::sqrt(square));
        }
    }

    void join_if_near(uint32_t i, uint32_t j, double distance) {
        if (distance > std::min(radii_[i], radii_[j])) return;
        if (distance <= std::min(smallest_radius(i), smallest_radius(j)) ||
            distance <= std::min(exact_radius(i), exact_radius(j))) {
            clusters_.join(i, j);
        }
    }

    std::span<const glm::dvec3> positions_;
    double tolerance_;
    glm::dvec3 origin_;
    PositionTree tree_;
    std::span<const Node> nodes_;
    std::vector<Reach> reaches_;
    std::vector<double> radii_;
    std::vector<bool> has_exact_radius_;
    Clusters clusters_;
};

}  // namespace

Weld weld(std::span<const glm::dvec3> positions, double tolerance) {
    if (positions.empty()) return {};
    return Welder(positions, tolerance).run();
}

}  // namespace tetralight::detail
