// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/walkable.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <tuple>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// As far below the surface as positions count as standing on it, metres.
constexpr double kSink = 0.01;
/// Ray queries multiply three lengths, which overflow beyond it.
constexpr double kMaxExtent = 1e12;
/// The search along a line ends after this number of triangles.
constexpr int kMaxHits = 1024;
/// A line and lines around it, one in each quadrant, so that corners of the surface belong to it. A
/// straight gap between triangles hides at most three of them.
constexpr glm::dvec3 kAround[] = {
    {0.0, 0.0, 0.0}, {0.8, 0.0, 0.6}, {-0.6, 0.0, 0.8}, {-0.8, 0.0, -0.6}, {0.6, 0.0, -0.8}};

glm::dvec3 normal_of(const WorldTriangle& triangle) {
    return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

bool is_walkable(const WorldTriangle& triangle) {
    constexpr double kMinCosine = 0.5;
    const glm::dvec3 normal = normal_of(triangle);
    return normal.y > kMinCosine * glm::length(normal);
}

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool is_less(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Sorts the triangles and the corners of each, so that their order changes no answer.
void sort_triangles(std::vector<WorldTriangle>& triangles) {
    for (WorldTriangle& triangle : triangles) {
        std::ranges::rotate(triangle, std::ranges::min_element(triangle, is_less));
    }
    std::ranges::sort(triangles, [](const WorldTriangle& a, const WorldTriangle& b) {
        return std::ranges::lexicographical_compare(a, b, is_less);
    });
}

/// The walkable ones in a fixed order.
Result<std::vector<WorldTriangle>> select_walkable(std::span<const WorldTriangle> triangles) {
    std::vector<WorldTriangle> selected;
    for (size_t i = 0; i < triangles.size(); ++i) {
        if (!std::ranges::all_of(triangles[i], is_finite)) {
            return Error{ErrorCode::InvalidArgument,
                         str_cat("walkable triangle ", i, " is not finite")};
        }
        if (is_walkable(triangles[i])) selected.push_back(triangles[i]);
    }
    if (selected.empty()) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat("none of ", triangles.size(),
                             " walkable triangles faces up, less than 60° off level")};
    }
    sort_triangles(selected);
    return selected;
}

WorldBox bounds_of(const std::vector<WorldTriangle>& triangles) {
    WorldBox box{triangles[0][0], triangles[0][0]};
    for (const WorldTriangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) {
            box.min = glm::min(box.min, corner);
            box.max = glm::max(box.max, corner);
        }
    }
    return box;
}

void add_triangles(const std::vector<WorldTriangle>& triangles, const glm::dvec3& origin,
                   RayCaster& caster) {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    for (const WorldTriangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) {
            indices.push_back(static_cast<uint32_t>(positions.size()));
            positions.emplace_back(corner - origin);
        }
    }
    caster.add_triangles(positions, indices);
}

void append_triangles(const Scene& scene, const MeshInstance& instance,
                      std::vector<WorldTriangle>& triangles) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool is_mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0.0;
    const bool is_double_sided =
        mesh.material < scene.materials.size() && scene.materials[mesh.material].is_double_sided;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        WorldTriangle triangle;
        for (size_t corner = 0; corner < 3; ++corner) {
            triangle[corner] = world_position(instance, mesh.positions[mesh.indices[i + corner]]);
        }
        const bool faces_down = is_double_sided && normal_of(triangle).y < 0.0;
        if (is_double_sided ? faces_down : is_mirrored) std::swap(triangle[1], triangle[2]);
        triangles.push_back(triangle);
    }
}

}  // namespace

Result<WalkableSurface> WalkableSurface::make(std::span<const WorldTriangle> triangles) {
    auto selected = select_walkable(triangles);
    if (!selected) return selected.error();
    WalkableSurface surface;
    surface.triangles_ = std::move(*selected);
    const WorldBox box = bounds_of(surface.triangles_);
    const glm::dvec3 size = box.max - box.min;
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent <= kMaxExtent)) {
        return Error{ErrorCode::Unsupported,
                     str_cat("the walkable surface is ", extent, " m large; at most ", kMaxExtent,
                             " m are supported")};
    }
    surface.origin_ = box.min + 0.5 * size;
    surface.max_y_ = box.max.y;
    // Not less than the rounding error of rays, which are float.
    surface.gap_ = std::max(1e-4, extent * 4.0 * std::numeric_limits<float>::epsilon());
    surface.merge_ = 10.0 * surface.gap_;
    add_triangles(surface.triangles_, surface.origin_, surface.caster_);
    if (auto status = surface.caster_.commit(); !status) return status.error();
    return surface;
}

double WalkableSurface::plane_height(const WorldTriangle& triangle,
                                     const glm::dvec3& center) const {
    const glm::dvec3 normal = normal_of(triangle);
    const glm::dvec3 offset = center - triangle[0];
    const double y = triangle[0].y - (normal.x * offset.x + normal.z * offset.z) / normal.y;
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    // The center may lie a gap beside the triangle, where the plane of a sliver leaves it.
    return std::clamp(y, low, high);
}

template <class Visit>
void WalkableSurface::visit_line(const glm::dvec3& line, const glm::dvec3& center,
                                 const Visit& visit) const {
    // Above the first place by more than what rounding and the gap change of heights.
    const double top = std::min(line.y, max_y_) + merge_;
    Ray ray{glm::vec3(glm::dvec3(line.x, top, line.z) - origin_), {0.0f, -1.0f, 0.0f}};
    for (int i = 0; i < kMaxHits; ++i) {
        const auto hit = caster_.intersect(ray);
        if (!hit || !visit(plane_height(triangles_[hit->primitive], center))) return;
        ray.min_distance = std::nextafter(hit->distance, std::numeric_limits<float>::infinity());
    }
}

std::optional<double> WalkableSurface::height_above(const glm::dvec3& position) const {
    const double highest = position.y + kSink;
    std::optional<double> foot;
    for (const glm::dvec3& around : kAround) {
        const glm::dvec3 line = position + gap_ * around + glm::dvec3(0.0, kSink, 0.0);
        visit_line(line, position, [&](double y) {
            if (y > highest) return true;
            // The line through the position itself comes first: its height is exact.
            if (!foot || y > *foot + merge_) foot = y;
            return false;
        });
    }
    if (!foot) return std::nullopt;
    return std::max(position.y - *foot, 0.0);
}

bool WalkableSurface::holds(const glm::dvec3& position, double agent_height) const {
    const auto height = height_above(position);
    return height && *height <= agent_height;
}

std::vector<glm::dvec3> WalkableSurface::feet_in_column(double x, double z, double max_y,
                                                        double min_y) const {
    const glm::dvec3 center(x, max_y, z);
    std::vector<glm::dvec3> feet;
    for (const glm::dvec3& around : kAround) {
        visit_line(center + gap_ * around, center, [&](double y) {
            if (y > max_y) return true;
            // Lower planes may reach up to here again, but not by more than this.
            if (y < min_y) return y > min_y - merge_;
            const bool is_known = std::ranges::any_of(
                feet, [&](const glm::dvec3& foot) { return std::abs(foot.y - y) < merge_; });
            if (!is_known) feet.emplace_back(x, y, z);
            return true;
        });
    }
    std::ranges::sort(feet, std::greater{}, &glm::dvec3::y);
    return feet;
}

std::vector<WorldTriangle> walkable_triangles(const Scene& scene) {
    std::vector<WorldTriangle> triangles;
    for (const MeshInstance& instance : scene.instances) {
        if (instance.is_walkable) append_triangles(scene, instance, triangles);
    }
    return triangles;
}

Result<std::vector<WorldTriangle>> read_walkable(const std::string& path) {
    auto scene = read_gltf(path);
    if (!scene) return scene.error();
    for (MeshInstance& instance : scene->instances) instance.is_walkable = true;
    auto triangles = walkable_triangles(*scene);
    if (!triangles.empty()) return triangles;
    return Error{ErrorCode::InvalidArgument, "navmesh", path,
                 path + ": contains no mesh to walk on"};
}

}  // namespace tetralight
