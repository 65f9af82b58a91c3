// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/bake/scene/reflectivity_map.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The surface at the hit of a ray.
struct Surface {
    glm::vec3 position{0.0f};
    /// Unit normal of the triangle, on the side that the ray came from.
    glm::vec3 geometric_normal{0.0f};
    /// Unit interpolated vertex normal, on the same side.
    glm::vec3 shading_normal{0.0f};
    /// Diffuse reflectivity.
    glm::vec3 albedo{0.0f};
    /// Emitted radiance.
    glm::vec3 emission{0.0f};
    uint32_t instance = 0;
    /// Indices of the triangle, as in `TraceScene::triangle`.
    uint32_t geometry = 0;
    uint32_t primitive = 0;
    /// Weights of the second and third corner of the triangle, in the order of the mesh.
    glm::vec2 barycentric{0.0f};
    /// Upper bound of the distance of `position` from the triangle by rounding, metres.
    float error_bound = 0.0f;
    /// The ray hit the triangle from behind.
    bool is_from_behind = false;
    /// The ray hit a single-sided triangle from behind.
    bool is_back_face = false;
};

/// The side of a surface that a ray hit, without its material.
struct SurfaceSide {
    float distance = 0.0f;
    /// Unit normal of the triangle, on the side that the ray came from.
    glm::vec3 normal{0.0f};
    /// As in `Surface`.
    uint32_t geometry = 0;
    uint32_t primitive = 0;
    bool is_from_behind = false;
    bool is_back_face = false;
};

/// A surface on the way of a ray.
struct Crossing {
    float distance = 0.0f;
    /// Fraction of rays that stop there, in [0, 1].
    float opacity = 1.0f;
};

/// The triangles of a scene, ready for ray queries. Rays and surfaces are in render space: world
/// space translated in double precision so that the center of the scene is the origin, because rays
/// are float.
///
/// Transparency: rays pass alpha-masked surfaces where alpha is below the cutoff, and alpha-blended
/// surfaces with probability 1 − alpha. The decision is a hash of the ray and the place of the hit,
/// so that `intersect` and `occluded` give the same answer for the same ray.
class TraceScene {
  public:
    /// Which instances rays can hit.
    using Selection = std::function<bool(const MeshInstance&)>;

    /// Builds the scene from the selected instances with all of their emission, for pictures. Keeps
    /// a reference to the scene. Returns out_of_resources if memory does not suffice, and
    /// unsupported if a vertex is farther than 1e12 m from the center of the scene.
    [[nodiscard]] static Result<TraceScene> make(const Scene& scene, const Selection& selection);

    /// Builds the scene from the instances that contribute global illumination, with the emission
    /// and the albedo of a bake. Also returns the errors of `check_lights`, and out_of_resources if
    /// the estimated memory exceeds the free memory.
    [[nodiscard]] static Result<TraceScene> make_static(const Scene& scene,
                                                        const SurfaceSettings& surfaces = {});

    [[nodiscard]] glm::vec3 render_from_world(const glm::dvec3& position) const {
        return glm::vec3(position - state_->origin);
    }

    [[nodiscard]] glm::dvec3 world_from_render(glm::vec3 position) const {
        return glm::dvec3(position) + state_->origin;
    }

    /// The light in render space.
    [[nodiscard]] Light render_from_world(Light light) const;

    /// Which members of a surface `intersect` evaluates.
    enum class Detail : bool {
        LightOnly,  ///< all but the shading normal, which is zero
        Full,
    };

    /// Spread of the rays of a bake, radians: a probe keeps nothing as fine as this, nor does light
    /// that a diffuse surface reflects. A ray of 1024 a sphere stands for a cone that is as wide,
    /// √(4π / 1024) = 0.11.
    static constexpr float kDiffuseSpread = 0.125f;

    /// The nearest surface on a ray. `spread`, radians: the albedo is the mean over a part of the
    /// surface with the width of the ray's cone, spread times distance (Akenine-Möller et al. 2021,
    /// "Improved Shader and Texture Level of Detail Using Ray Cones"), at most 8 to 16 texels; the
    /// direction must be a unit vector. Grazing rays have longer footprints, of which only the
    /// width counts. 0, or a scene for pictures: the albedo at the point. Emission and transparency
    /// are always those at the point.
    [[nodiscard]] std::optional<Surface> intersect(const Ray& ray, Detail detail = Detail::Full,
                                                   float spread = 0.0f) const;

    /// The side of the surface that `intersect` finds. Costs no more than the ray.
    [[nodiscard]] std::optional<SurfaceSide> intersect_side(const Ray& ray) const;

    [[nodiscard]] bool occluded(const Ray& ray) const { return caster_.occluded(ray); }

    /// The nearest surface that a ray meets, transparent or not.
    [[nodiscard]] std::optional<Crossing> nearest_crossing(const Ray& ray) const;

    /// The ray queries on the triangles, in render space.
    [[nodiscard]] const RayCaster& caster() const { return caster_; }

    /// See `RayCaster::listen`.
    void listen(RayListener listener) { caster_.listen(listener); }

    /// The point on any surface that is nearest to a position, in render space. Ignores
    /// transparency. None if all are farther than `max_distance`, metres: short searches are much
    /// faster.
    [[nodiscard]] std::optional<glm::vec3> nearest_surface(
        glm::vec3 position, float max_distance = std::numeric_limits<float>::infinity()) const {
        return caster_.nearest_point(position, max_distance);
    }

    /// Origin of a ray that leaves the surface on the side that `direction`, one of its normals,
    /// points to: offset by the bound of the rounding error, so that the ray does not hit its own
    /// triangle.
    [[nodiscard]] static glm::vec3 ray_origin(const Surface& surface, glm::vec3 direction) {
        return surface.position + surface.error_bound * direction;
    }

    /// The same for the side that a ray hit at `hit` = origin + distance · direction. The bound
    /// includes the rounding error of `hit`.
    [[nodiscard]] glm::vec3 ray_origin(const SurfaceSide& side, glm::vec3 hit,
                                       glm::vec3 direction) const;

    /// A sampled point on a triangle.
    struct TrianglePoint {
        std::array<glm::vec3, 3> corners{};
        glm::vec3 position{0.0f};
        glm::vec3 normal{0.0f};  ///< unit, on the side that emits
    };

    /// End of a shadow ray from `origin`: offset from the triangle by the bound of the rounding
    /// error of both, so that the ray does not hit the triangle.
    [[nodiscard]] static glm::vec3 shadow_target(const TrianglePoint& point, glm::vec3 origin);

    /// Number of instances that rays can hit. Geometries are counted from 0.
    [[nodiscard]] uint32_t geometry_count() const {
        return static_cast<uint32_t>(state_->geometries.size());
    }

    [[nodiscard]] uint32_t triangle_count(uint32_t geometry_index) const;

    /// Corners of a triangle in render space, counter-clockwise as seen from the front.
    [[nodiscard]] std::array<glm::vec3, 3> triangle(uint32_t geometry_index,
                                                    uint32_t primitive) const;

    [[nodiscard]] bool is_double_sided(uint32_t geometry_index) const;

    /// Index of the material of a geometry in the scene.
    [[nodiscard]] uint32_t material(uint32_t geometry_index) const {
        return state_->geometries[geometry_index].mesh->material;
    }

    /// True if any point of a geometry may emit light, and if its emission may vary over its
    /// points.
    [[nodiscard]] bool can_emit(uint32_t geometry_index) const;
    [[nodiscard]] bool has_varied_emission(uint32_t geometry_index) const;

    /// Radiance emitted at a point of a triangle times its opacity. `barycentric`: weights of the
    /// second and third corner.
    [[nodiscard]] glm::vec3 visible_emission(uint32_t geometry_index, uint32_t primitive,
                                             glm::vec2 barycentric) const;

    /// True if any surface is alpha-blended, so that shadows are noisy.
    [[nodiscard]] bool has_blending() const;

  private:
    /// All that a hit reads of its triangle, in one cache line.
    struct alignas(64) Triangle {
        /// In render space, in the order of the mesh.
        std::array<glm::vec3, 3> corners{};
        /// Texture coordinates of the corners, in the set of `Geometry::uv_set`.
        std::array<glm::vec2, 3> uvs{};
        /// Length in texture coordinates of one metre on the triangle: the square root of the ratio
        /// of their areas.
        float uv_per_metre = 0.0f;
    };

    static_assert(sizeof(Triangle) == 64);

    /// An instance, as a geometry of the ray caster.
    struct Geometry {
        uint32_t instance = 0;
        const Mesh* mesh = nullptr;
        const Material* material = nullptr;
        glm::mat3 normal_from_mesh{1.0f};
        bool is_mirrored = false;
        /// The texture coordinates that `triangles` have: those of the base color if it has a
        /// texture. kNoIndex = none.
        uint32_t uv_set = kNoIndex;
        bool can_emit = false;
        /// True if no texture or vertex color changes the emission: it is `constant_emission`.
        bool has_constant_emission = false;
        glm::vec3 constant_emission{0.0f};
        /// Null: hits read the textures.
        const ReflectivityMap* reflectivity = nullptr;
        std::vector<Triangle> triangles;
    };

    /// Which materials emit.
    enum class Emission : uint8_t { All, Baked };

    struct State {
        const Scene* scene = nullptr;
        SurfaceSettings surfaces;
        Emission emission = Emission::All;
        bool has_reflectivity_maps = false;
        /// One a material; empty for those that have none, and in scenes for pictures.
        std::vector<std::optional<ReflectivityMap>> reflectivity_maps;
        std::vector<Geometry> geometries;
        glm::dvec3 origin{0.0};
    };

    TraceScene(std::unique_ptr<State> state, RayCaster caster)
        : state_(std::move(state)), caster_(std::move(caster)) {}

    static Result<TraceScene> make_from(const Scene& scene, const Selection& selection,
                                        std::unique_ptr<State> state);
    static Geometry make_geometry(const State& state, uint32_t instance);
    static void make_reflectivity_maps(State& state);
    static std::vector<Triangle> make_triangles(const Geometry& geometry,
                                                const std::vector<glm::vec3>& positions);
    static bool takes_emission(const State& state, const Material& material);
    static glm::vec3 corner_weights(const Geometry& geometry, const RayHit& hit);
    static MeshPoint mesh_point_of(const Geometry& geometry, const RayHit& hit);
    static float opacity(const State& state, const Geometry& geometry, const RayHit& hit);
    static glm::vec3 albedo(const State& state, const Geometry& geometry, const RayHit& hit,
                            float spread);
    static glm::vec3 emission(const State& state, const Geometry& geometry, const RayHit& hit);
    static bool accepts_hit(const void* state, const Ray& ray, const RayHit& hit);

    std::unique_ptr<State> state_;  // on the heap: the hit filter points to it
    RayCaster caster_;
};

}  // namespace tetralight
