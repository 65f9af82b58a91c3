// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/bsp_tree.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {
namespace {

/// A tetrahedron of which a part may be in the region of a node.
struct BspEntry {
    uint32_t tetrahedron = 0;
    /// Bit i: the region is on the inner side of the face opposite corner i.
    uint32_t inside = 0;
};

constexpr uint32_t kInsideAll = 15;

using BspEntries = std::vector<BspEntry>;

struct BspPlane {
    glm::vec3 normal{0.0f};
    float distance = 0.0f;
    /// The tetrahedron, and the corner opposite the face, that the plane is of.
    uint32_t tetrahedron = 0;
    int face = 0;
};

/// Where the corners of a tetrahedron are.
struct BspSides {
    bool is_over = false;
    bool is_under = false;
    /// The bit of the face that lies in the plane.
    uint32_t face = 0;
};

/// Planes that are compared at a node, and tetrahedra that they are compared by.
constexpr size_t kPlanesTried = 48, kEntriesTried = 128;

class BspBuilder {
  public:
    BspBuilder(std::span<const glm::vec3> points,
               std::span<const std::array<uint32_t, 4>> tetrahedra)
        : points_(points), tetrahedra_(tetrahedra) {}

    BspTree build() {
        BspEntries all;
        for (uint32_t i = 0; i < tetrahedra_.size(); ++i) all.push_back({i, 0});
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
        while (true) {
            if (const auto leaf = leaf_of(entries, depth)) return *leaf;
            const auto plane = best_plane(entries);
            if (!plane) return leaf(entries.front());
            auto [over, under] = split(entries, *plane);
            if (over.empty()) {
                entries = std::move(under);
                continue;
            }
            entries = {};
            const size_t node = tree_.nodes.size();
            tree_.nodes.push_back({plane->normal, plane->distance, 0, 0});
            tree_.depth = std::max(tree_.depth, depth);
            const int32_t over_child = build(std::move(over), depth + 1);
            const int32_t under_child = build(std::move(under), depth + 1);
            tree_.nodes[node].over = over_child;
            tree_.nodes[node].under = under_child;
            return static_cast<int32_t>(node);
        }
    }

    static int32_t leaf(const BspEntry& entry) {
        return -static_cast<int32_t>(entry.tetrahedron) - 1;
    }

    static std::optional<int32_t> leaf_of(const BspEntries& entries, uint32_t depth) {
        if (entries.size() == 1 || depth > kDeepestBsp) return leaf(entries.front());
        const auto found = std::ranges::find(entries, kInsideAll, &BspEntry::inside);
        if (found == entries.end()) return std::nullopt;
        return leaf(*found);
    }

    /// The plane with the least work below, by an estimate; none if all planes are used.
    [[nodiscard]] std::optional<BspPlane> best_plane(const BspEntries& entries) const {
        const size_t plane_step = (4 * entries.size() + kPlanesTried - 1) / kPlanesTried;
        std::optional<BspPlane> best;
        double least = 0.0;
        for (size_t start = 0; start < plane_step && !best; ++start) {
            for (size_t i = start; i < 4 * entries.size(); i += plane_step) {
                const auto plane = plane_of(entries[i / 4], static_cast<int>(i % 4));
                if (!plane) continue;
                const double work = work_below(entries, *plane);
                if (best && work >= least) continue;
                best = plane;
                least = work;
            }
        }
        return best;
    }

    /// The plane of a face, with an outward normal. None if the face is used, or has no area.
    [[nodiscard]] std::optional<BspPlane> plane_of(const BspEntry& entry, int face) const {
        if ((entry.inside >> face & 1) != 0) return std::nullopt;
        const auto& vertices = tetrahedra_[entry.tetrahedron];
        const auto& corners = kOutwardFaces[static_cast<size_t>(face)];
        const glm::dvec3 a = point(vertices, corners[0]);
        const glm::dvec3 b = point(vertices, corners[1]);
        const glm::dvec3 c = point(vertices, corners[2]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return std::nullopt;
        const glm::vec3 unit(normal / length);
        const double distance = glm::dot(glm::dvec3(unit), (a + b + c) / 3.0);
        return BspPlane{unit, static_cast<float>(distance), entry.tetrahedron, face};
    }

    [[nodiscard]] glm::dvec3 point(const std::array<uint32_t, 4>& vertices, int corner) const {
        return glm::dvec3(points_[vertices[static_cast<size_t>(corner)]]);
    }

    /// m log m for both sides, of some of the entries.
    [[nodiscard]] double work_below(const BspEntries& entries, const BspPlane& plane) const {
        const size_t step = (entries.size() + kEntriesTried - 1) / kEntriesTried;
        double over = 0.0;
        double under = 0.0;
        for (size_t i = 0; i < entries.size(); i += step) {
            const BspSides sides = sides_of(entries[i], plane);
            over += sides.is_over ? 1.0 : 0.0;
            under += sides.is_under ? 1.0 : 0.0;
        }
        return over * std::log2(over + 1.0) + under * std::log2(under + 1.0);
    }

    [[nodiscard]] BspSides sides_of(const BspEntry& entry, const BspPlane& plane) const {
        if (entry.tetrahedron == plane.tetrahedron) return {false, true, 1u << plane.face};
        BspSides sides;
        uint32_t on = 0;
        const auto& vertices = tetrahedra_[entry.tetrahedron];
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec3 product = glm::dvec3(plane.normal) * point(vertices, corner);
            const double distance = plane.distance;
            const double side = product.x + product.y + product.z - distance;
            // Several times the rounding of a walk in floats.
            const double rounding = 0x1p-22 * (std::abs(product.x) + std::abs(product.y) +
                                               std::abs(product.z) + std::abs(distance));
            sides.is_over |= side > rounding;
            sides.is_under |= side < -rounding;
            if (std::abs(side) <= rounding) on |= 1u << corner;
        }
        if (!sides.is_over && !sides.is_under) sides.is_under = true;
        for (uint32_t corner = 0; corner < 4; ++corner) {
            if (on == (kInsideAll & ~(1u << corner))) sides.face = 1u << corner;
        }
        return sides;
    }

    [[nodiscard]] std::pair<BspEntries, BspEntries> split(const BspEntries& entries,
                                                          const BspPlane& plane) const {
        std::pair<BspEntries, BspEntries> parts;
        for (const BspEntry& entry : entries) {
            const BspSides sides = sides_of(entry, plane);
            const BspEntry part{entry.tetrahedron, entry.inside | sides.face};
            if (sides.is_over) parts.first.push_back(part);
            if (sides.is_under) parts.second.push_back(part);
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
