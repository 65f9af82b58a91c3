// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/seams.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {
namespace {

/// An edge of a triangle that is the border of its chart.
struct BorderEdge {
    uint32_t triangle = 0;
    uint32_t corner = 0;  ///< its first corner, 0 to 2; the second is the next one
};

using PositionKey = std::array<float, 3>;

PositionKey key_of(const glm::vec3& position) {
    return {position.x + 0.0f, position.y + 0.0f, position.z + 0.0f};  // no -0
}

/// The borders of the charts of one packing.
std::vector<BorderEdge> border_edges(const Mesh& mesh, const LightmapPacking& packing) {
    const auto position = [&](uint32_t triangle, uint32_t corner) {
        return key_of(mesh.positions[mesh.indices[3 * size_t{triangle} + corner % 3]]);
    };
    const auto uv = [&](uint32_t triangle, uint32_t corner) {
        return packing.charts.corner_uvs[3 * size_t{triangle} + corner % 3];
    };
    std::map<std::pair<PositionKey, PositionKey>, std::vector<BorderEdge>> edges;
    const auto count = static_cast<uint32_t>(packing.charts.corner_uvs.size() / 3);
    for (uint32_t triangle = 0; triangle < count; ++triangle) {
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const PositionKey a = position(triangle, corner), b = position(triangle, corner + 1);
            if (a != b) edges[std::minmax(a, b)].push_back({triangle, corner});
        }
    }
    std::vector<BorderEdge> borders;
    for (const auto& [ends, sides] : edges) {
        if (sides.size() == 2) {
            const auto [a, b] = std::pair(sides[0], sides[1]);
            const bool is_inside = uv(a.triangle, a.corner) == uv(b.triangle, b.corner + 1) &&
                                   uv(a.triangle, a.corner + 1) == uv(b.triangle, b.corner);
            if (is_inside) continue;
        }
        borders.insert(borders.end(), sides.begin(), sides.end());
    }
    std::ranges::sort(borders, {},
                      [](const BorderEdge& edge) { return std::pair(edge.triangle, edge.corner); });
    return borders;
}

/// A border edge in the world.
struct WorldEdge {
    PageEdge place;
    std::array<glm::dvec3, 2> ends{};
    std::array<glm::dvec3, 2> normals{};
};

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

class EdgeReader {
  public:
    EdgeReader(const Scene& scene, const LightmapLayout& layout, uint32_t instance)
        : instance_(scene.instances[instance]),
          mesh_(scene.meshes[instance_.mesh]),
          place_(layout.places[instance]),
          packing_(layout.packings[place_.packing]) {
        const glm::dmat3 linear(instance_.world_from_mesh);
        normal_matrix_ = glm::transpose(glm::inverse(linear));
        handedness_ = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    }

    [[nodiscard]] WorldEdge read(const BorderEdge& border) const {
        WorldEdge edge;
        edge.place.page = place_.corner.page;
        const std::array<uint32_t, 2> corners{border.corner, (border.corner + 1) % 3};
        for (size_t i = 0; i < 2; ++i) {
            const size_t corner = 3 * size_t{border.triangle} + corners[i];
            edge.ends[i] = world_position(instance_, mesh_.positions[mesh_.indices[corner]]);
            edge.normals[i] = normal_at(border.triangle, corner);
            const glm::vec2 uv =
                packing_.charts.corner_uvs[corner] + glm::vec2(place_.corner.x, place_.corner.y);
            (i == 0 ? edge.place.begin : edge.place.end) = uv;
        }
        return edge;
    }

  private:
    [[nodiscard]] glm::dvec3 normal_at(uint32_t triangle, size_t corner) const {
        if (!mesh_.normals.empty()) {
            return unit_or_zero(normal_matrix_ * glm::dvec3(mesh_.normals[mesh_.indices[corner]]));
        }
        const uint32_t* indices = mesh_.indices.data() + 3 * size_t{triangle};
        const glm::dvec3 a = world_position(instance_, mesh_.positions[indices[0]]);
        return handedness_ *
               unit_or_zero(glm::cross(world_position(instance_, mesh_.positions[indices[1]]) - a,
                                       world_position(instance_, mesh_.positions[indices[2]]) - a));
    }

    const MeshInstance& instance_;
    const Mesh& mesh_;
    const LightmapPlace& place_;
    const LightmapPacking& packing_;
    glm::dmat3 normal_matrix_{1.0};
    double handedness_ = 1.0;
};

std::vector<WorldEdge> world_edges(const Scene& scene, const LightmapLayout& layout,
                                   const std::vector<bool>& joins) {
    std::vector<std::vector<BorderEdge>> borders(layout.packings.size());
    std::vector<bool> is_known(layout.packings.size(), false);
    std::vector<WorldEdge> edges;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const LightmapPlace& place = layout.places[i];
        if (!place.has_lightmap() || !joins[i]) continue;
        const LightmapPacking& packing = layout.packings[place.packing];
        if (!is_known[place.packing]) {
            borders[place.packing] = border_edges(scene.meshes[packing.mesh], packing);
            is_known[place.packing] = true;
        }
        const EdgeReader reader(scene, layout, i);
        for (const BorderEdge& border : borders[place.packing])
            edges.push_back(reader.read(border));
    }
    return edges;
}

/// Edges by the middle between their ends.
class EdgeGrid {
  public:
    EdgeGrid(const std::vector<WorldEdge>& edges, double max_distance)
        : edges_(edges), reach_(max_distance), cell_size_(8.0 * max_distance) {
        for (uint32_t i = 0; i < edges.size(); ++i) cells_[cell_of(middle(edges[i]))].push_back(i);
    }

    /// Calls visit(i) for each edge whose middle may be within the distance of that of an edge.
    template <class Visit>
    void for_each_near(const WorldEdge& edge, const Visit& visit) const {
        const Cell low = cell_of(middle(edge) - reach_), high = cell_of(middle(edge) + reach_);
        for (int64_t x = low[0]; x <= high[0]; ++x) {
            for (int64_t y = low[1]; y <= high[1]; ++y) {
                for (int64_t z = low[2]; z <= high[2]; ++z) visit_cell({x, y, z}, visit);
            }
        }
    }

  private:
    using Cell = std::array<int64_t, 3>;

    struct CellHash {
        size_t operator()(const Cell& cell) const noexcept {
            uint64_t hash = 0;
            for (const int64_t i : cell)
                hash = (hash ^ static_cast<uint64_t>(i)) * 0x9e3779b97f4a7c15u;
            return hash ^ hash >> 32;
        }
    };

    static glm::dvec3 middle(const WorldEdge& edge) { return 0.5 * (edge.ends[0] + edge.ends[1]); }

    [[nodiscard]] Cell cell_of(const glm::dvec3& position) const {
        constexpr double kLargest = 0x1p62;
        Cell cell{};
        for (int axis = 0; axis < 3; ++axis) {
            cell[static_cast<size_t>(axis)] = static_cast<int64_t>(
                std::clamp(std::floor(position[axis] / cell_size_), -kLargest, kLargest));
        }
        return cell;
    }

    template <class Visit>
    void visit_cell(const Cell& cell, const Visit& visit) const {
        const auto found = cells_.find(cell);
        if (found == cells_.end()) return;
        for (const uint32_t i : found->second) visit(i);
    }

    const std::vector<WorldEdge>& edges_;
    double reach_, cell_size_;
    std::unordered_map<Cell, std::vector<uint32_t>, CellHash> cells_;
};

PageEdge reversed(const PageEdge& edge) {
    return {edge.page, edge.end, edge.begin};
}

/// True if the ends of `b`, in this order, are those of `a` on a smooth surface.
bool is_same_edge(const WorldEdge& a, const WorldEdge& b, std::array<size_t, 2> order,
                  const SeamSettings& settings) {
    const double least_cosine = std::cos(settings.max_angle_degrees * std::numbers::pi / 180.0);
    for (size_t i = 0; i < 2; ++i) {
        if (glm::distance(a.ends[i], b.ends[order[i]]) > settings.max_distance) return false;
        if (glm::dot(a.normals[i], b.normals[order[i]]) < least_cosine) return false;
    }
    return true;
}

}  // namespace

std::vector<Seam> find_seams(const Scene& scene, const LightmapLayout& layout,
                             const std::vector<bool>& joins, const SeamSettings& settings) {
    const std::vector<WorldEdge> edges = world_edges(scene, layout, joins);
    const EdgeGrid grid(edges, settings.max_distance);
    std::vector<Seam> seams;
    std::vector<uint32_t> near;
    for (uint32_t i = 0; i < edges.size(); ++i) {
        near.clear();
        grid.for_each_near(edges[i], [&](uint32_t k) {
            if (k > i) near.push_back(k);
        });
        std::ranges::sort(near);
        for (const uint32_t k : near) {
            if (is_same_edge(edges[i], edges[k], {0, 1}, settings)) {
                seams.push_back({edges[i].place, edges[k].place, edges[i].ends});
            } else if (is_same_edge(edges[i], edges[k], {1, 0}, settings)) {
                seams.push_back({edges[i].place, reversed(edges[k].place), edges[i].ends});
            }
        }
    }
    return seams;
}

}  // namespace tetralight
