// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/bsp_tree.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include <tetralight/engines/detail/convex_part.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {
namespace {

/// What the planes above a node leave of a tetrahedron.
struct BspEntry {
    uint32_t tetrahedron = 0;
    /// Empty: all of it.
    ConvexPart part;
};

using BspEntries = std::vector<BspEntry>;

/// The plane of a face.
struct BspPlane {
    CutPlane plane;
    uint32_t tetrahedron = 0;
};

struct BspSides {
    bool is_over = false;
    bool is_under = false;
};

/// Planes that are compared at a node, and tetrahedra that they are compared by.
constexpr size_t kPlanesTried = 32, kEntriesTried = 64;

class BspBuilder {
  public:
    BspBuilder(std::span<const glm::vec3> points,
               std::span<const std::array<uint32_t, 4>> tetrahedra)
        : points_(points), tetrahedra_(tetrahedra) {}

    BspTree build() {
        BspEntries all;
        for (uint32_t i = 0; i < tetrahedra_.size(); ++i) all.push_back({i, {}});
        const int32_t root = build(std::move(all), 1);
        if (root < 0) tree_ = {{{{1.0f, 0.0f, 0.0f}, 0.0f, root, root}}, 1};
        return std::move(tree_);
    }

  private:
    std::span<const glm::vec3> points_;
    std::span<const std::array<uint32_t, 4>> tetrahedra_;
    BspTree tree_;

    /// Returns the index of a new node, or a leaf.
    int32_t build(BspEntries entries, uint32_t depth) {
        const int32_t leaf = -static_cast<int32_t>(entries.front().tetrahedron) - 1;
        if (entries.size() == 1 || depth > kDeepestBsp) return leaf;
        const auto plane = best_plane(entries);
        if (!plane) return leaf;
        auto [over, under] = split(std::move(entries), *plane);
        const size_t node = tree_.nodes.size();
        tree_.nodes.push_back({plane->plane.normal, plane->plane.distance, 0, 0});
        tree_.depth = std::max(tree_.depth, depth);
        const int32_t over_child = build(std::move(over), depth + 1);
        const int32_t under_child = build(std::move(under), depth + 1);
        tree_.nodes[node].over = over_child;
        tree_.nodes[node].under = under_child;
        return static_cast<int32_t>(node);
    }

    /// The plane with the least work below, by an estimate. None if all tetrahedra are under the
    /// planes of all faces.
    [[nodiscard]] std::optional<BspPlane> best_plane(const BspEntries& entries) const {
        const size_t plane_step = (4 * entries.size() + kPlanesTried - 1) / kPlanesTried;
        std::optional<BspPlane> best;
        double least = std::numeric_limits<double>::infinity();
        for (size_t start = 0; start < plane_step && !best; ++start) {
            for (size_t i = start; i < 4 * entries.size(); i += plane_step) {
                const auto plane = plane_of(entries[i / 4].tetrahedron, i % 4);
                if (!plane) continue;
                const double work = work_below(entries, *plane);
                if (work >= least) continue;
                best = plane;
                least = work;
            }
        }
        return best;
    }

    /// The plane of a face, with an outward normal. None if the face has no area.
    [[nodiscard]] std::optional<BspPlane> plane_of(uint32_t tetrahedron, size_t face) const {
        const auto corners = corners_of(tetrahedron);
        const auto& [i, j, k] = kOutwardFaces[face];
        const glm::dvec3& a = corners[static_cast<size_t>(i)];
        const glm::dvec3& b = corners[static_cast<size_t>(j)];
        const glm::dvec3& c = corners[static_cast<size_t>(k)];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return std::nullopt;
        const glm::vec3 unit(normal / length);
        const double distance = glm::dot(glm::dvec3(unit), (a + b + c) / 3.0);
        return BspPlane{{unit, static_cast<float>(distance)}, tetrahedron};
    }

    [[nodiscard]] std::array<glm::dvec3, 4> corners_of(uint32_t tetrahedron) const {
        std::array<glm::dvec3, 4> corners;
        for (size_t i = 0; i < 4; ++i) {
            corners[i] = glm::dvec3(points_[tetrahedra_[tetrahedron][i]]);
        }
        return corners;
    }

    /// The squares of the numbers on both sides, of some of the entries: m log m gives trees that
    /// are three times as deep. Infinite if nothing is over the plane.
    [[nodiscard]] double work_below(const BspEntries& entries, const BspPlane& plane) const {
        const size_t step = (entries.size() + kEntriesTried - 1) / kEntriesTried;
        double over = 0.0;
        double under = 0.0;
        for (size_t i = 0; i < entries.size(); i += step) {
            const BspSides sides = sides_of(entries[i], plane);
            over += sides.is_over ? 1.0 : 0.0;
            under += sides.is_under ? 1.0 : 0.0;
        }
        if (over == 0.0) return std::numeric_limits<double>::infinity();
        return over * over + under * under;
    }

    [[nodiscard]] BspSides sides_of(const BspEntry& entry, const BspPlane& plane) const {
        if (entry.tetrahedron == plane.tetrahedron) return {false, true};
        BspSides sides;
        const auto add = [&](const glm::dvec3& point) {
            const double distance = distance_over(plane.plane, point);
            sides.is_over |= distance > 0.0;
            sides.is_under |= distance < 0.0;
            return sides.is_over && sides.is_under;
        };
        if (entry.part.points.empty()) {
            static_cast<void>(std::ranges::any_of(corners_of(entry.tetrahedron), add));
        } else {
            static_cast<void>(std::ranges::any_of(entry.part.points, add));
        }
        return sides;
    }

    /// What is over and what is under the plane. Parts in the plane are left out.
    [[nodiscard]] std::pair<BspEntries, BspEntries> split(BspEntries entries,
                                                          const BspPlane& plane) const {
        std::pair<BspEntries, BspEntries> parts;
        for (BspEntry& entry : entries) {
            const BspSides sides = sides_of(entry, plane);
            if (sides.is_over && sides.is_under) {
                if (entry.part.points.empty()) {
                    entry.part = convex_part(corners_of(entry.tetrahedron));
                }
                parts.first.push_back(
                    {entry.tetrahedron, cut(entry.part, plane.plane, Side::Over)});
                parts.second.push_back(
                    {entry.tetrahedron, cut(entry.part, plane.plane, Side::Under)});
            } else if (sides.is_over) {
                parts.first.push_back(std::move(entry));
            } else if (sides.is_under) {
                parts.second.push_back(std::move(entry));
            }
        }
        return parts;
    }
};

}  // namespace

BspTree make_bsp_tree(std::span<const glm::vec3> points,
                      std::span<const std::array<uint32_t, 4>> tetrahedra) {
    return BspBuilder(points, tetrahedra).build();
}

uint32_t find_tetrahedron(std::span<const BspNode> nodes, glm::vec3 position) {
    int32_t node = 0;
    while (node >= 0) {
        const BspNode& plane = nodes[static_cast<size_t>(node)];
        node = glm::dot(plane.normal, position) > plane.distance ? plane.over : plane.under;
    }
    return static_cast<uint32_t>(-(node + 1));
}

}  // namespace tetralight::detail
