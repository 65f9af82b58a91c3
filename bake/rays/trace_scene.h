// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// What a ray sees at a hit.
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
    /// The triangle that was hit, as `TraceScene` counts them.
    uint32_t geometry = 0;
    uint32_t primitive = 0;
    /// How far `position` and rays that start there may be off the triangle by rounding.
    float error_bound = 0.0f;
    /// The ray came from behind the triangle.
    bool is_from_behind = false;
    /// It did, and the material has only a front.
    bool is_back_face = false;
};

/// Which side of a surface a ray sees.
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

/// A scene's triangles ready for rays. Rays and surfaces are in render space: world space moved so
/// that the scene's middle is the origin, done in double, because rays are float.
///
/// Transparency: hits of alpha-masked surfaces below the cutoff are skipped; blended ones are
/// skipped with probability 1 − alpha, by a hash of the ray, in `cast` and `occluded` alike.
class TraceScene {
  public:
    /// Which instances rays can hit.
    using Selection = std::function<bool(const MeshInstance&)>;

    /// Builds from the selected instances, with all that they emit: what an eye sees. Keeps a
    /// reference to the scene. Errors: not enough
    /// memory, a vertex farther than 1e12 m from the middle.
    [[nodiscard]] static Result<TraceScene> make(const Scene& scene, const Selection& selection);

    /// Built from what contributes global illumination, with the emission and the reflectivity that
    /// a bake takes. Errors: a light that is none, and a scene that free memory does not hold.
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

    /// What of a surface `cast` looks up.
    enum class Detail : bool {
        LightOnly,  ///< all but the shading normal, which stays zero
        Full,
    };

    [[nodiscard]] std::optional<Surface> intersect(const Ray& ray,
                                                   Detail detail = Detail::Full) const;

    /// The side of the surface that `cast` finds, without its material: at the price of the ray.
    [[nodiscard]] std::optional<SurfaceSide> intersect_side(const Ray& ray) const;

    [[nodiscard]] bool occluded(const Ray& ray) const { return caster_.occluded(ray); }

    /// What finds the hits, in render space.
    [[nodiscard]] const RayCaster& caster() const { return caster_; }

    /// Default: none. Not while rays are cast.
    void listen(RayListener listener) { caster_.listen(listener); }

    /// The nearest point of any surface, in render space; transparency does not count.
    [[nodiscard]] std::optional<glm::vec3> nearest_surface(glm::vec3 position) const {
        return caster_.nearest_point(position);
    }

    /// Where a ray starts that leaves the surface on the side that `direction`, one of its normals,
    /// points to: off it by more than rounding and no farther than that.
    [[nodiscard]] static glm::vec3 ray_origin(const Surface& surface, glm::vec3 direction) {
        return surface.position + surface.error_bound * direction;
    }

    /// The same for the side that a ray met at `hit` = origin + distance · direction, which its own
    /// rounding moves too.
    [[nodiscard]] glm::vec3 ray_origin(const SurfaceSide& side, glm::vec3 hit,
                                       glm::vec3 direction) const;

    /// A point of a triangle that was drawn instead of met.
    struct TrianglePoint {
        std::array<glm::vec3, 3> corners{};
        glm::vec3 position{0.0f};
        glm::vec3 normal{0.0f};  ///< unit, on the side that is looked at
    };

    /// Where a shadow ray ends that comes from `seen_from`: off the triangle by more than the
    /// rounding of both.
    [[nodiscard]] static glm::vec3 shadow_target(const TrianglePoint& point, glm::vec3 seen_from);

    /// How many instances rays can hit: geometries are counted from 0.
    [[nodiscard]] uint32_t geometry_count() const {
        return static_cast<uint32_t>(state_->geometries.size());
    }

    [[nodiscard]] uint32_t triangle_count(uint32_t geometry_index) const;

    /// Corners of a triangle in render space, counter-clockwise seen from the front.
    [[nodiscard]] std::array<glm::vec3, 3> triangle(uint32_t geometry_index,
                                                    uint32_t primitive) const;

    [[nodiscard]] bool is_double_sided(uint32_t geometry_index) const;

    /// Index of a geometry's material in the scene.
    [[nodiscard]] uint32_t material(uint32_t geometry_index) const {
        return state_->geometries[geometry_index].mesh->material;
    }

    /// Whether any point of a geometry may emit light, and whether its points may differ.
    [[nodiscard]] bool can_emit(uint32_t geometry_index) const;
    [[nodiscard]] bool has_varied_emission(uint32_t geometry_index) const;

    /// Radiance that leaves a point of a triangle, times the share of rays that stop there.
    /// `barycentric`: weights of the second and third of its corners.
    [[nodiscard]] glm::vec3 visible_emission(uint32_t geometry_index, uint32_t primitive,
                                             glm::vec2 barycentric) const;

    /// Whether any surface lets a part of the rays through, so that shadows are drawn at random.
    [[nodiscard]] bool has_blending() const;

  private:
    /// An instance as a geometry of the caster.
    struct Geometry {
        uint32_t instance = 0;
        const Mesh* mesh = nullptr;
        const Material* material = nullptr;
        glm::mat3 normal_from_mesh{1.0f};
        bool is_mirrored = false;
        /// The mesh's vertices in render space, as the caster has them.
        std::vector<glm::vec3> positions;
    };

    /// Which emission rays see.
    enum class Emission : uint8_t { All, Baked };

    struct State {
        const Scene* scene = nullptr;
        SurfaceSettings surfaces;
        Emission emission = Emission::All;
        std::vector<Geometry> geometries;
        glm::dvec3 origin{0.0};
    };

    TraceScene(std::unique_ptr<State> state, RayCaster caster)
        : state_(std::move(state)), caster_(std::move(caster)) {}

    static Result<TraceScene> make_from(const Scene& scene, const Selection& selection,
                                        std::unique_ptr<State> state);
    static Geometry make_geometry(const Scene& scene, uint32_t instance);
    static bool takes_emission(const State& state, const Material& material);
    static bool accepts_hit(const void* state, const Ray& ray, const RayHit& hit);

    std::unique_ptr<State> state_;  // on the heap: the caster's filter points to it
    RayCaster caster_;
};

}  // namespace tetralight
