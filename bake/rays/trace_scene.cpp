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
#include <tetralight/bake/scene/texture.h>
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

template <class T>
T blend(const std::array<T, 3>& corners, glm::vec3 weights) {
    return corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
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
void place_surface(const std::array<glm::vec3, 3>& corners, glm::vec3 weights, Surface& surface) {
    float extent = 0.0f;
    for (const glm::vec3& corner : corners) extent = std::max(extent, largest_coordinate(corner));
    // Relative to one corner, so that weights whose sum is not exactly 1 keep the point in the
    // plane.
    const glm::dvec3 first(corners[0]);
    const glm::dvec3 position = first + (glm::dvec3(corners[1]) - first) * double{weights.y} +
                                (glm::dvec3(corners[2]) - first) * double{weights.z};
    surface.position = glm::vec3(position);
    surface.error_bound = error_bound(extent);
}

/// Twice the area of a triangle.
float double_area(const std::array<glm::vec3, 3>& corners) {
    return glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

float double_area(const std::array<glm::vec2, 3>& corners) {
    const glm::vec2 first = corners[1] - corners[0], second = corners[2] - corners[0];
    return std::abs(first.x * second.y - first.y * second.x);
}

/// The texture coordinates that the triangles of a mesh keep: see `Geometry::uv_set`.
uint32_t used_uv_set(const Material& material, const Mesh& mesh) {
    const TextureUse& use = material.base_color_texture.texture != kNoIndex
                                ? material.base_color_texture
                                : material.metallic_roughness_texture;
    return use.texture == kNoIndex || mesh.uvs[use.uv_set].empty() ? kNoIndex : use.uv_set;
}

/// A key of the triangle of a hit, or of its edge or corner if the hit lies on one, by position. A
/// ray through an edge may hit the triangles on both sides, and both have to give the same answer.
uint64_t key_of_hit_place(const RayHit& hit, const std::array<glm::vec3, 3>& corners,
                          glm::vec3 weights) {
    constexpr float kOnEdge = 1e-5f;
    uint64_t key = 0;
    int corner_count = 0;
    for (int i = 0; i < 3; ++i) {
        if (!(weights[i] > kOnEdge)) continue;
        key += probe_key(0, glm::dvec3(corners[i]));
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
    state->has_reflectivity_maps = true;
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
        Geometry geometry = make_geometry(*state, i);
        const auto positions = render_positions(*geometry.mesh, instance, state->origin);
        if (!positions)
            return positions.error().in(str_cat("instance ", i, " \"", instance.name, '"'));
        geometry.triangles = make_triangles(geometry, *positions);
        const auto& indices = geometry.mesh->indices;
        const bool is_opaque = geometry.material->alpha_mode == AlphaMode::Opaque;
        caster.add_triangles(*positions, geometry.is_mirrored ? mirrored(indices) : indices,
                             is_opaque ? RayCaster::Filtered::No : RayCaster::Filtered::Yes);
        state->geometries.push_back(std::move(geometry));
    }
    if (state->has_reflectivity_maps) make_reflectivity_maps(*state);
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

TraceScene::Geometry TraceScene::make_geometry(const State& state, uint32_t index) {
    const MeshInstance& instance = state.scene->instances[index];
    const Mesh& mesh = state.scene->meshes[instance.mesh];
    const Material& material = state.scene->materials[mesh.material];
    const bool is_mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0.0;
    Geometry geometry;
    geometry.instance = index;
    geometry.mesh = &mesh;
    geometry.material = &material;
    geometry.normal_from_mesh = normal_from_mesh(instance) * (is_mirrored ? -1.0f : 1.0f);
    geometry.is_mirrored = is_mirrored;
    geometry.uv_set = used_uv_set(material, mesh);
    const EmissionSource emission = emission_source(material);
    geometry.can_emit = takes_emission(state, material) && emission.factor != glm::vec3(0.0f);
    geometry.has_constant_emission =
        emission.texture.texture == kNoIndex && (!material.is_unlit || mesh.colors.empty());
    geometry.constant_emission = emission.factor;
    return geometry;
}

std::vector<TraceScene::Triangle> TraceScene::make_triangles(
    const Geometry& geometry, const std::vector<glm::vec3>& positions) {
    const Mesh& mesh = *geometry.mesh;
    std::vector<Triangle> triangles(mesh.indices.size() / 3);
    for (size_t i = 0; i < triangles.size(); ++i) {
        Triangle& triangle = triangles[i];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.indices[3 * i + k];
            triangle.corners[k] = positions[vertex];
            if (geometry.uv_set != kNoIndex) triangle.uvs[k] = mesh.uvs[geometry.uv_set][vertex];
        }
        const float ratio = double_area(triangle.uvs) / double_area(triangle.corners);
        triangle.uv_per_metre = std::isfinite(ratio) ? std::sqrt(ratio) : 0.0f;
    }
    return triangles;
}

void TraceScene::make_reflectivity_maps(State& state) {
    const Scene& scene = *state.scene;
    state.reflectivity_maps.resize(scene.materials.size());
    for (Geometry& geometry : state.geometries) {
        const Material& material = *geometry.material;
        const bool has_colors = !geometry.mesh->colors.empty();
        if (!has_reflectivity_map(scene, material, state.surfaces, has_colors)) continue;
        auto& map = state.reflectivity_maps[geometry.mesh->material];
        if (!map) map = make_reflectivity_map(scene, material, state.surfaces);
        if (map->levels.empty() || geometry.uv_set != kNoIndex) geometry.reflectivity = &*map;
    }
}

/// Weights of the corners of a triangle in the order of the mesh.
glm::vec3 TraceScene::corner_weights(const Geometry& geometry, const RayHit& hit) {
    glm::vec2 b = hit.barycentric;
    if (geometry.is_mirrored) std::swap(b.x, b.y);
    return {1.0f - b.x - b.y, b.x, b.y};
}

MeshPoint TraceScene::mesh_point_of(const Geometry& geometry, const RayHit& hit) {
    const glm::vec3 weights = corner_weights(geometry, hit);
    return mesh_point(*geometry.mesh, hit.primitive, {weights.y, weights.z});
}

/// Fraction of rays that stop at a point.
float TraceScene::opacity(const State& state, const Geometry& geometry, const RayHit& hit) {
    const Material& material = *geometry.material;
    if (material.alpha_mode == AlphaMode::Opaque) return 1.0f;
    float alpha = material.base_color.a;
    const TextureUse& use = material.base_color_texture;
    if (use.texture != kNoIndex && geometry.uv_set != kNoIndex) {
        const Triangle& triangle = geometry.triangles[hit.primitive];
        const glm::vec2 uv = blend(triangle.uvs, corner_weights(geometry, hit));
        alpha *= sample_texture_alpha(state.scene->textures[use.texture],
                                      use.image_from_mesh * glm::vec3(uv, 1.0f));
    }
    if (!geometry.mesh->colors.empty()) {
        alpha *= mesh_point_of(geometry, hit).blend(geometry.mesh->colors).a;
    }
    if (material.alpha_mode == AlphaMode::Blend) return std::clamp(alpha, 0.0f, 1.0f);
    return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
}

bool TraceScene::accepts_hit(const void* context, const Ray& ray, const RayHit& hit) {
    const State& state = *static_cast<const State*>(context);
    const Geometry& geometry = state.geometries[hit.geometry];
    const float alpha = opacity(state, geometry, hit);
    if (alpha <= 0.0f || alpha >= 1.0f) return alpha > 0.0f;
    const auto& corners = geometry.triangles[hit.primitive].corners;
    return hash_of(ray, key_of_hit_place(hit, corners, corner_weights(geometry, hit))) < alpha;
}

glm::vec3 TraceScene::albedo(const State& state, const Geometry& geometry, const RayHit& hit,
                             float spread) {
    if (spread > 0.0f && geometry.reflectivity != nullptr) {
        const Triangle& triangle = geometry.triangles[hit.primitive];
        const auto reflectivity = filtered_reflectivity(
            *geometry.reflectivity, blend(triangle.uvs, corner_weights(geometry, hit)),
            spread * hit.distance * triangle.uv_per_metre);
        if (reflectivity) {
            glm::vec3 color(*reflectivity);
            if (!geometry.mesh->colors.empty()) {
                color *= glm::vec3(mesh_point_of(geometry, hit).blend(geometry.mesh->colors));
            }
            return glm::clamp(color + reflectivity->a, 0.0f, state.surfaces.max_albedo);
        }
    }
    const MeshPoint point = mesh_point_of(geometry, hit);
    return adjusted_albedo(diffuse_reflectivity(*state.scene, point), state.surfaces);
}

glm::vec3 TraceScene::emission(const State& state, const Geometry& geometry, const RayHit& hit) {
    if (geometry.has_constant_emission) return geometry.constant_emission;
    return emitted_radiance(*state.scene, mesh_point_of(geometry, hit));
}

std::optional<Surface> TraceScene::intersect(const Ray& ray, Detail detail, float spread) const {
    const std::optional<RayHit> hit = caster_.intersect(ray);
    if (!hit) return std::nullopt;
    const Geometry& geometry = state_->geometries[hit->geometry];

    std::optional<Surface> result(std::in_place);  // no copy of a surface
    Surface& surface = *result;
    const glm::vec3 weights = corner_weights(geometry, *hit);
    place_surface(geometry.triangles[hit->primitive].corners, weights, surface);
    surface.barycentric = {weights.y, weights.z};
    surface.geometric_normal = glm::normalize(hit->normal);
    if (detail == Detail::Full) {
        surface.shading_normal = shading_normal(
            mesh_point_of(geometry, *hit), geometry.normal_from_mesh, surface.geometric_normal);
    }
    surface.albedo = albedo(*state_, geometry, *hit, spread);
    if (geometry.can_emit) surface.emission = emission(*state_, geometry, *hit);
    surface.instance = geometry.instance;
    surface.geometry = hit->geometry;
    surface.primitive = hit->primitive;
    if (glm::dot(surface.geometric_normal, ray.direction) > 0.0f) {
        surface.geometric_normal = -surface.geometric_normal;
        surface.shading_normal = -surface.shading_normal;
        surface.is_from_behind = true;
        surface.is_back_face = !geometry.material->is_double_sided;
    }
    return result;
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
    return Crossing{hit->distance, opacity(*state_, geometry, *hit)};
}

uint32_t TraceScene::triangle_count(uint32_t geometry_index) const {
    return static_cast<uint32_t>(state_->geometries[geometry_index].triangles.size());
}

std::array<glm::vec3, 3> TraceScene::triangle(uint32_t geometry_index, uint32_t primitive) const {
    const Geometry& geometry = state_->geometries[geometry_index];
    std::array<glm::vec3, 3> corners = geometry.triangles[primitive].corners;
    if (geometry.is_mirrored) std::swap(corners[1], corners[2]);
    return corners;
}

bool TraceScene::is_double_sided(uint32_t geometry_index) const {
    return state_->geometries[geometry_index].material->is_double_sided;
}

bool TraceScene::takes_emission(const State& state, const Material& material) {
    return material.bakes_emission || state.emission == Emission::All;
}

bool TraceScene::can_emit(uint32_t geometry_index) const {
    return state_->geometries[geometry_index].can_emit;
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
    if (!geometry.can_emit) return glm::vec3(0.0f);
    RayHit hit;
    hit.primitive = primitive;
    hit.barycentric = barycentric;
    return emission(*state_, geometry, hit) * opacity(*state_, geometry, hit);
}

bool TraceScene::has_blending() const {
    return std::any_of(
        state_->geometries.begin(), state_->geometries.end(),
        [](const Geometry& geometry) { return geometry.material->alpha_mode == AlphaMode::Blend; });
}

}  // namespace tetralight
