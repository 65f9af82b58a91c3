// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/trace_scene.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/check_lights.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Indices with the opposite winding: glTF flips the front of instances with negative determinant.
std::vector<uint32_t> mirrored(std::vector<uint32_t> indices) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
    return indices;
}

/// Cofactor matrix of the linear part, which transforms normals correctly under any scale.
/// Multiplied by the sign of the determinant, it keeps them on the front side of mirrored
/// instances.
glm::mat3 normal_from_mesh(const MeshInstance& instance) {
    const glm::dmat3 m(instance.world_from_mesh);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, glm::length(cofactors[i]));
    return largest > 0.0 ? glm::mat3(cofactors / largest) : glm::mat3(0.0f);
}

MeshPoint hit_point(const Mesh& mesh, bool is_mirrored, const RayHit& hit) {
    const glm::vec2 b = hit.barycentric;
    return mesh_point(mesh, hit.primitive, is_mirrored ? glm::vec2(b.y, b.x) : b);
}

glm::vec3 shading_normal(const MeshPoint& point, const glm::mat3& from_mesh,
                         glm::vec3 geometric_normal) {
    if (point.mesh->normals.empty()) return geometric_normal;
    const glm::vec3 normal = from_mesh * point.blend(point.mesh->normals);
    const float length = glm::length(normal);
    return length > 0.0f ? normal / length : geometric_normal;
}

/// Bound of the distance between a triangle and the start or end of a ray on it by rounding, if no
/// coordinate is larger than `extent`. Corners, positions and origins are rounded to half a unit in
/// the last place, 2^-24 of their size; Embree subtracts the origin from the corners and
/// multiplies, which adds a few times as much. Measured on random triangles of any size: with
/// 2^-23, one in 300 grazing rays still hits its own triangle; with 2^-21, only rays whose angle to
/// the triangle is smaller than the rounding of their direction do.
float error_bound(float extent) {
    return extent * 0x1p-21f;
}

float largest_coordinate(glm::vec3 position) {
    return std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
}

/// Limit of coordinates, metres: ray queries multiply three lengths, which overflow beyond it.
constexpr double kMaxCoordinate = 1e12;

/// The vertices of a mesh in render space. Returns unsupported if one is too far from the origin.
Result<std::vector<glm::vec3>> render_positions(const Mesh& mesh, const MeshInstance& instance,
                                                const glm::dvec3& origin) {
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 offset = world_position(instance, position) - origin;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(offset[axis]) <= kMaxCoordinate) continue;
            return Error{ErrorCode::Unsupported,
                         str_cat("vertex ", positions.size(), " is ", std::abs(offset[axis]),
                                 " m from the center of the scene; at most ", kMaxCoordinate,
                                 " m are supported")};
        }
        positions.emplace_back(offset);
    }
    return positions;
}

/// Computes the hit point from the corners instead of the ray, whose error grows with its length
/// (Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection").
void place_surface(const MeshPoint& point, const std::vector<glm::vec3>& corners,
                   Surface& surface) {
    const glm::vec3* triangle[3];
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) {
        triangle[i] = &corners[point.corners[i]];
        extent = std::max(extent, largest_coordinate(*triangle[i]));
    }
    // Relative to one corner, so that weights whose sum is not exactly 1 keep the point in the
    // plane.
    const glm::dvec3 first(*triangle[0]);
    const glm::dvec3 position = first +
                                (glm::dvec3(*triangle[1]) - first) * double{point.weights.y} +
                                (glm::dvec3(*triangle[2]) - first) * double{point.weights.z};
    surface.position = glm::vec3(position);
    surface.error_bound = error_bound(extent);
}

/// Fraction of rays that stop at a point.
float opacity(const Scene& scene, const MeshPoint& point) {
    const Material& material = scene.materials[point.mesh->material];
    if (material.alpha_mode == AlphaMode::Opaque) return 1.0f;
    const float alpha = base_color(scene, point).a;
    if (material.alpha_mode == AlphaMode::Blend) return std::clamp(alpha, 0.0f, 1.0f);
    return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
}

/// A key of the triangle of a hit, or of its edge or corner if the hit lies on one, by position. A
/// ray through an edge may hit the triangles on both sides, and both have to give the same answer.
uint64_t key_of_hit_place(const RayHit& hit, const MeshPoint& point,
                          const std::vector<glm::vec3>& positions) {
    constexpr float kOnEdge = 1e-5f;
    uint64_t key = 0;
    int corner_count = 0;
    for (int i = 0; i < 3; ++i) {
        if (!(point.weights[i] > kOnEdge)) continue;
        key += probe_key(0, glm::dvec3(positions[point.corners[i]]));
        ++corner_count;
    }
    return corner_count < 3 ? key : (uint64_t{hit.geometry} << 32 | hit.primitive);
}

/// A hash in [0, 1) of the ray and the place of the hit.
float hash_of(const Ray& ray, uint64_t place_key) {
    const uint64_t origin_key = probe_key(place_key, glm::dvec3(ray.origin));
    return RandomStream(probe_key(origin_key, glm::dvec3(ray.direction)), 0).next();
}

}  // namespace

Result<TraceScene> TraceScene::make(const Scene& scene, const Selection& selection) {
    return make_from(scene, selection, std::make_unique<State>());
}

Result<TraceScene> TraceScene::make_static(const Scene& scene, const SurfaceSettings& surfaces) {
    if (auto status = check_lights(scene); !status) return status.error();
    if (auto status = check_bake_memory(estimate_bake_memory(scene, 0)); !status)
        return status.error();
    auto state = std::make_unique<State>();
    state->surfaces = surfaces;
    state->emission = Emission::Baked;
    const auto is_static = [](const MeshInstance& instance) { return instance.contributes_gi; };
    return make_from(scene, is_static, std::move(state));
}

Result<TraceScene> TraceScene::make_from(const Scene& scene, const Selection& selection,
                                         std::unique_ptr<State> state) {
    state->scene = &scene;
    state->origin = scene_center(scene, selection);

    RayCaster caster({&TraceScene::accepts_hit, state.get()});
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        if (!selection(instance) || scene.meshes[instance.mesh].indices.empty()) continue;
        Geometry geometry = make_geometry(scene, i);
        auto positions = render_positions(*geometry.mesh, instance, state->origin);
        if (!positions)
            return positions.error().in(str_cat("instance ", i, " \"", instance.name, '"'));
        geometry.positions = std::move(*positions);
        const auto& indices = geometry.mesh->indices;
        const bool is_opaque = geometry.material->alpha_mode == AlphaMode::Opaque;
        caster.add_triangles(geometry.positions, geometry.is_mirrored ? mirrored(indices) : indices,
                             is_opaque ? RayCaster::Filtered::No : RayCaster::Filtered::Yes);
        state->geometries.push_back(std::move(geometry));
    }
    if (auto status = caster.commit(); !status) return status.error();
    return TraceScene(std::move(state), std::move(caster));
}

glm::vec3 TraceScene::shadow_target(const TrianglePoint& point, glm::vec3 origin) {
    float extent = largest_coordinate(origin);
    for (const glm::vec3& corner : point.corners) {
        extent = std::max(extent, largest_coordinate(corner));
    }
    return point.position + error_bound(extent) * point.normal;
}

Light TraceScene::render_from_world(Light light) const {
    light.position = render_from_world(glm::dvec3(light.position));
    return light;
}

TraceScene::Geometry TraceScene::make_geometry(const Scene& scene, uint32_t index) {
    const MeshInstance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool is_mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0.0;
    return {index,
            &mesh,
            &scene.materials[mesh.material],
            normal_from_mesh(instance) * (is_mirrored ? -1.0f : 1.0f),
            is_mirrored,
            {}};
}

bool TraceScene::accepts_hit(const void* context, const Ray& ray, const RayHit& hit) {
    const State& state = *static_cast<const State*>(context);
    const Geometry& geometry = state.geometries[hit.geometry];
    const MeshPoint point = hit_point(*geometry.mesh, geometry.is_mirrored, hit);
    const float alpha = opacity(*state.scene, point);
    if (alpha <= 0.0f || alpha >= 1.0f) return alpha > 0.0f;
    return hash_of(ray, key_of_hit_place(hit, point, geometry.positions)) < alpha;
}

std::optional<Surface> TraceScene::intersect(const Ray& ray, Detail detail) const {
    const std::optional<RayHit> hit = caster_.intersect(ray);
    if (!hit) return std::nullopt;
    const Scene& scene = *state_->scene;
    const Geometry& geometry = state_->geometries[hit->geometry];
    const Material& material = *geometry.material;
    const MeshPoint point = hit_point(*geometry.mesh, geometry.is_mirrored, *hit);

    Surface surface;
    place_surface(point, geometry.positions, surface);
    surface.geometric_normal = glm::normalize(hit->normal);
    if (detail == Detail::Full) {
        surface.shading_normal =
            shading_normal(point, geometry.normal_from_mesh, surface.geometric_normal);
    }
    surface.albedo = adjusted_albedo(diffuse_reflectivity(scene, point), state_->surfaces);
    if (takes_emission(*state_, material)) surface.emission = emitted_radiance(scene, point);
    surface.instance = geometry.instance;
    surface.geometry = hit->geometry;
    surface.primitive = hit->primitive;
    if (glm::dot(surface.geometric_normal, ray.direction) > 0.0f) {
        surface.geometric_normal = -surface.geometric_normal;
        surface.shading_normal = -surface.shading_normal;
        surface.is_from_behind = true;
        surface.is_back_face = !material.is_double_sided;
    }
    return surface;
}

glm::vec3 TraceScene::ray_origin(const SurfaceSide& side, glm::vec3 hit,
                                 glm::vec3 direction) const {
    float extent = side.distance;
    for (const glm::vec3& corner : triangle(side.geometry, side.primitive)) {
        for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, std::abs(corner[axis]));
    }
    return hit + error_bound(extent) * direction;
}

std::optional<SurfaceSide> TraceScene::intersect_side(const Ray& ray) const {
    const std::optional<RayHit> hit = caster_.intersect(ray);
    if (!hit) return std::nullopt;
    const Geometry& geometry = state_->geometries[hit->geometry];
    SurfaceSide side{hit->distance, glm::normalize(hit->normal), hit->geometry, hit->primitive};
    if (glm::dot(side.normal, ray.direction) > 0.0f) {
        side.normal = -side.normal;
        side.is_from_behind = true;
        side.is_back_face = !geometry.material->is_double_sided;
    }
    return side;
}

std::optional<Crossing> TraceScene::nearest_crossing(const Ray& ray) const {
    const std::optional<RayHit> hit = caster_.intersect_unfiltered(ray);
    if (!hit) return std::nullopt;
    const Geometry& geometry = state_->geometries[hit->geometry];
    const MeshPoint point = hit_point(*geometry.mesh, geometry.is_mirrored, *hit);
    return Crossing{hit->distance, opacity(*state_->scene, point)};
}

uint32_t TraceScene::triangle_count(uint32_t geometry_index) const {
    return static_cast<uint32_t>(state_->geometries[geometry_index].mesh->indices.size() / 3);
}

std::array<glm::vec3, 3> TraceScene::triangle(uint32_t geometry_index, uint32_t primitive) const {
    const Geometry& geometry = state_->geometries[geometry_index];
    const uint32_t* corners = &geometry.mesh->indices[size_t{primitive} * 3];
    std::array<glm::vec3, 3> positions{geometry.positions[corners[0]],
                                       geometry.positions[corners[1]],
                                       geometry.positions[corners[2]]};
    if (geometry.is_mirrored) std::swap(positions[1], positions[2]);
    return positions;
}

bool TraceScene::is_double_sided(uint32_t geometry_index) const {
    return state_->geometries[geometry_index].material->is_double_sided;
}

bool TraceScene::takes_emission(const State& state, const Material& material) {
    return material.bakes_emission || state.emission == Emission::All;
}

bool TraceScene::can_emit(uint32_t geometry_index) const {
    const Material& material = *state_->geometries[geometry_index].material;
    return takes_emission(*state_, material) && emission_source(material).factor != glm::vec3(0.0f);
}

bool TraceScene::has_varied_emission(uint32_t geometry_index) const {
    const Material& material = *state_->geometries[geometry_index].material;
    const bool has_varied_base = material.base_color_texture.texture != kNoIndex ||
                                 !state_->geometries[geometry_index].mesh->colors.empty();
    const bool shows_base = material.is_unlit || material.alpha_mode != AlphaMode::Opaque;
    return material.emission_texture.texture != kNoIndex || (shows_base && has_varied_base);
}

glm::vec3 TraceScene::visible_emission(uint32_t geometry_index, uint32_t primitive,
                                       glm::vec2 barycentric) const {
    const Geometry& geometry = state_->geometries[geometry_index];
    if (!takes_emission(*state_, *geometry.material)) return glm::vec3(0.0f);
    RayHit hit;
    hit.primitive = primitive;
    hit.barycentric = barycentric;
    const MeshPoint point = hit_point(*geometry.mesh, geometry.is_mirrored, hit);
    return emitted_radiance(*state_->scene, point) * opacity(*state_->scene, point);
}

bool TraceScene::has_blending() const {
    return std::any_of(
        state_->geometries.begin(), state_->geometries.end(),
        [](const Geometry& geometry) { return geometry.material->alpha_mode == AlphaMode::Blend; });
}

}  // namespace tetralight
