// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/texel_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <tetralight/charts/rasterize_texels.h>

namespace tetralight {
namespace {

/// Distance of points from the edges of their triangle, texels.
constexpr double kInset = 0.02;

/// Rounding of coordinates in pages, texels.
constexpr double kOnBorder = 1e-3;

using Corners = std::array<glm::vec2, 3>;

Corners corners_of(const LightmapPacking& packing, uint32_t triangle) {
    const glm::vec2* uvs = packing.charts.corner_uvs.data() + size_t{3} * triangle;
    return {uvs[0], uvs[1], uvs[2]};
}

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// A point of a triangle in the plane of the texels.
struct Nearest {
    double distance2 = std::numeric_limits<double>::infinity();
    glm::dvec2 offset{0.0};  ///< from the target
    ChartPoint point;
};

/// Weights of the second and third corner of the point of the triangle nearest to `target`.
glm::dvec2 nearest_barycentric(const std::array<glm::dvec2, 3>& corners, glm::dvec2 target) {
    const glm::dvec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const glm::dvec2 w = target - corners[0];
    const double area = cross(u, v);
    if (area != 0.0) {
        const glm::dvec2 inside(cross(w, v) / area, cross(u, w) / area);
        if (inside.x >= 0.0 && inside.y >= 0.0 && inside.x + inside.y <= 1.0) return inside;
    }
    constexpr std::array<glm::dvec2, 3> kWeights{glm::dvec2(0, 0), glm::dvec2(1, 0),
                                                 glm::dvec2(0, 1)};
    glm::dvec2 best(0.0);
    double best_distance2 = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = corners[i], edge = corners[(i + 1) % 3] - a;
        const double length2 = glm::dot(edge, edge);
        const double t =
            length2 > 0.0 ? std::clamp(glm::dot(target - a, edge) / length2, 0.0, 1.0) : 0.0;
        const glm::dvec2 offset = a + t * edge - target;
        if (glm::dot(offset, offset) >= best_distance2) continue;
        best_distance2 = glm::dot(offset, offset);
        best = (1.0 - t) * kWeights[i] + t * kWeights[(i + 1) % 3];
    }
    return best;
}

/// Moves a point away from the edges of its triangle.
glm::dvec2 inset(const std::array<glm::dvec2, 3>& corners, glm::dvec2 barycentric) {
    const double longest =
        std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                  glm::distance(corners[2], corners[0])});
    const double area = std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
    // A weight times the height over an edge is the distance from it.
    const double least = area > 0.0 ? std::min(1.0 / 3.0, kInset * longest / area) : 1.0 / 3.0;
    std::array<double, 3> weights{1.0 - barycentric.x - barycentric.y, barycentric.x,
                                  barycentric.y};
    const double smallest = std::min({weights[0], weights[1], weights[2]});
    if (smallest >= least) return barycentric;
    // Towards the centroid.
    const double t = std::min(1.0, (least - smallest) / (1.0 / 3.0 - smallest));
    return (1.0 - t) * barycentric + t * glm::dvec2(1.0 / 3.0);
}

/// The triangles that touch each texel, by texel.
struct TouchedTexels {
    std::vector<std::pair<uint32_t, uint32_t>> texel_triangles;  ///< sorted

    [[nodiscard]] size_t end_of(size_t begin) const {
        size_t end = begin;
        while (end < texel_triangles.size() &&
               texel_triangles[end].first == texel_triangles[begin].first) {
            ++end;
        }
        return end;
    }
};

class MapBuilder {
  public:
    MapBuilder(const Mesh& mesh, const LightmapPacking& packing, uint32_t grid)
        : mesh_(mesh), packing_(packing), grid_(grid) {
        map_.width = packing.charts.width;
        map_.height = packing.charts.height;
        map_.charts.assign(size_t{map_.width} * map_.height, kNoIndex);
    }

    TexelMap run() {
        TouchedTexels touched;
        const auto count = static_cast<uint32_t>(packing_.triangle_charts.size());
        for (uint32_t triangle = 0; triangle < count; ++triangle) {
            const Corners corners = corners_of(packing_, triangle);
            for_each_texel(corners, 0.5f, [&](uint32_t texel) {
                map_.charts[texel] = packing_.triangle_charts[triangle];
            });
            if (!has_area(triangle)) continue;
            for_each_texel(corners, 0.0f, [&](uint32_t texel) {
                touched.texel_triangles.emplace_back(texel, triangle);
            });
        }
        std::ranges::sort(touched.texel_triangles);
        std::vector<Touched> all;
        for (size_t begin = 0; begin < touched.texel_triangles.size();) {
            const size_t end = touched.end_of(begin);
            all.push_back(
                touched_texel(std::span(touched.texel_triangles).subspan(begin, end - begin)));
            begin = end;
        }
        std::set<uint32_t> covering;  // charts that cover a part of a texel
        for (const Touched& texel : all) {
            if (!texel.is_at_border) covering.insert(texel.chart);
        }
        for (const Touched& texel : all) {
            // A surface that ends at the border of a texel covers none of it. One that has no other
            // texel, because it is too small, takes the first.
            if (!texel.is_at_border || covering.insert(texel.chart).second) add_texel(texel);
        }
        return std::move(map_);
    }

  private:
    /// The texels of the rectangle that the triangle touches.
    template <class Visit>
    void for_each_texel(const Corners& corners, float margin, Visit&& visit) const {
        for_each_touched_texel(corners, margin, [&](int32_t x, int32_t y) {
            if (x < 0 || y < 0) return;
            const auto column = static_cast<uint32_t>(x), row = static_cast<uint32_t>(y);
            if (column < map_.width && row < map_.height) visit(row * map_.width + column);
        });
    }

    [[nodiscard]] bool has_area(uint32_t triangle) const {
        const uint32_t* indices = mesh_.indices.data() + size_t{3} * triangle;
        const glm::dvec3 a(mesh_.positions[indices[0]]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(mesh_.positions[indices[1]]) - a,
                                             glm::dvec3(mesh_.positions[indices[2]]) - a);
        return glm::dot(normal, normal) > 0.0;
    }

    using TexelTriangles = std::span<const std::pair<uint32_t, uint32_t>>;

    [[nodiscard]] Nearest nearest(TexelTriangles triangles, glm::dvec2 target) const {
        Nearest best;
        for (const auto& [texel, triangle] : triangles) {
            const Corners floats = corners_of(packing_, triangle);
            const std::array<glm::dvec2, 3> corners{floats[0], floats[1], floats[2]};
            const glm::dvec2 weights = nearest_barycentric(corners, target);
            const glm::dvec2 offset = corners[0] + weights.x * (corners[1] - corners[0]) +
                                      weights.y * (corners[2] - corners[0]) - target;
            const double distance2 = glm::dot(offset, offset);
            if (distance2 >= best.distance2) continue;
            best = {distance2, offset, {triangle, glm::vec2(inset(corners, weights))}};
        }
        return best;
    }

    /// A texel that triangles touch, and their point nearest to its center.
    struct Touched {
        TexelTriangles triangles;
        Nearest center;
        uint32_t chart = 0;
        bool is_at_border = false;
    };

    [[nodiscard]] glm::dvec2 corner_of(uint32_t texel) const {
        return {texel % map_.width, texel / map_.width};
    }

    [[nodiscard]] Touched touched_texel(TexelTriangles triangles) const {
        Touched texel{triangles, nearest(triangles, corner_of(triangles[0].first) + 0.5)};
        const glm::dvec2 offset = glm::abs(texel.center.offset);
        texel.chart = packing_.triangle_charts[triangles[0].second];
        texel.is_at_border = std::max(offset.x, offset.y) > 0.5 - kOnBorder;
        return texel;
    }

    void add_texel(const Touched& touched) {
        const TexelTriangles triangles = touched.triangles;
        const uint32_t index = triangles[0].first;
        const glm::dvec2 corner = corner_of(index);
        TexelMap::Texel texel{index, static_cast<uint32_t>(map_.points.size()), 0};
        map_.points.push_back(touched.center.point);
        for (uint32_t i = 0; i < grid_ * grid_; ++i) {
            const glm::dvec2 place(0.5 + i % grid_, 0.5 + i / grid_);
            const Nearest found = nearest(triangles, corner + place / static_cast<double>(grid_));
            constexpr double kOnTriangle = 1e-12;
            if (found.distance2 < kOnTriangle) map_.points.push_back(found.point);
        }
        texel.point_count = static_cast<uint32_t>(map_.points.size()) - texel.first_point;
        map_.texels.push_back(texel);
    }

    const Mesh& mesh_;
    const LightmapPacking& packing_;
    uint32_t grid_;
    TexelMap map_;
};

}  // namespace

TexelMap make_texel_map(const Mesh& mesh, const LightmapPacking& packing, uint32_t grid) {
    return MapBuilder(mesh, packing, grid).run();
}

}  // namespace tetralight
