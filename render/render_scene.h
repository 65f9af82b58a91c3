// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/mirror.h>
#include <tetralight/render/scene_light.h>
#include <tetralight/render/surface_view.h>

namespace tetralight {

/// Shades a scene with a volume's light, as an engine would with this runtime.
/// - Normal maps change the normals that light falls on: of lights, of probes, and of lightmaps
///   (`LightmapLight`).
/// - Static surfaces sample their lightmap on the side of their normals. On the other side, or
///   without a lightmap, they query the probes at each point.
/// - Moving objects (`contributes_gi` false) query once, at the center of their bounds, or sample a
///   proxy volume if their node asks for one.
/// - Lights of the volume that are not `Baked` add their direct term with shadow rays. If probes
///   store the occlusion of a light, it replaces the shadows that static objects cast on moving
///   ones, and shadow rays test moving objects only. The shadow mask of lightmaps does the same for
///   static surfaces. Subtractive lightmaps hold the light, and moving objects subtract it.
/// - With reflection probes, surfaces also mirror their cubes, as rough as they are.
/// - Lights and baked emission are scaled by the weights of the volume's layers.
class SceneShader {
  public:
    /// Keeps references. Returns out_of_resources if memory is short, and the errors of proxy
    /// volumes.
    [[nodiscard]] static Result<SceneShader> make(const Scene& scene, const ProbeVolumeView& volume,
                                                  ProbeLight probes = ProbeLight::AsTheScene);

    /// The same with given light. Returns out_of_resources if memory is short.
    [[nodiscard]] static Result<SceneShader> make(const Scene& scene, const ProbeVolumeView& volume,
                                                  SceneLight light);

    [[nodiscard]] std::span<const Lppv> proxy_volumes() const { return light_.proxy_volumes; }

    /// A shaded point.
    struct Shaded {
        glm::vec3 radiance{0.0f};  ///< towards the origin of the ray, or the colour of the view
        float distance = 0.0f;
    };

    /// Shades the first surface that a ray hits; empty if it hits none.
    [[nodiscard]] std::optional<Shaded> shade(const glm::dvec3& origin, glm::vec3 direction,
                                              SurfaceView view = SurfaceView::Shaded) const;

    /// Distance to the point that `shade` would shade.
    [[nodiscard]] std::optional<float> distance(const glm::dvec3& origin,
                                                glm::vec3 direction) const;

    /// Which objects cast a shadow.
    enum class Casters : bool { All, Moving };

    /// True if the scene blocks a ray from a world position within a distance.
    [[nodiscard]] bool occluded(const glm::dvec3& origin, glm::vec3 direction, float distance,
                                Casters casters = Casters::All) const;

  private:
    SceneShader(const Scene& scene, const ProbeVolumeView& volume, SceneLight light,
                TraceScene traced, TraceScene moving);

    [[nodiscard]] const TraceScene& casters(Casters casters) const {
        return casters == Casters::All ? traced_ : moving_;
    }

    /// Back faces of single-sided materials are culled, as rasterizers do.
    [[nodiscard]] std::optional<Surface> first_front_face(glm::vec3 origin,
                                                          glm::vec3 direction) const;
    [[nodiscard]] PackedSh probe_light(const Surface& surface) const;
    /// Where a surface lies in the page of its lightmap. Precondition: its instance has one.
    [[nodiscard]] glm::vec2 page_uv_at(const Surface& surface) const;
    /// The shading normal with the normal map.
    [[nodiscard]] glm::vec3 normal_with_map(const Surface& surface) const;
    [[nodiscard]] bool has_lightmap(const Surface& surface) const;
    /// Irradiance / π from probes or from the lightmap. `base_normal`: without the normal map.
    [[nodiscard]] glm::vec3 baked_light(const Surface& surface, const glm::vec3& base_normal) const;
    /// The same from the lightmap, with the shadows of moving objects if they darken it.
    [[nodiscard]] glm::vec3 lightmap_light(const Surface& surface,
                                           const glm::vec3& base_normal) const;
    [[nodiscard]] glm::vec3 direct_term(const Surface& surface) const;
    [[nodiscard]] glm::vec3 emitted(const Surface& surface) const;
    /// Light from a surface that shines, towards the origin of a ray in this direction.
    [[nodiscard]] glm::vec3 shiny_light(const Surface& surface, const glm::vec3& base_normal,
                                        glm::vec3 direction) const;
    [[nodiscard]] glm::vec3 show(const Surface& surface, const glm::vec3& base_normal,
                                 glm::vec3 direction, SurfaceView view) const;

    const Scene* scene_;
    ProbeVolumeView volume_;
    SceneLight light_;  // lights in render space
    Mirror mirror_;
    TraceScene traced_;
    TraceScene moving_;
};

/// Radiance of the sky in a direction, from the volume's ambient probe.
[[nodiscard]] glm::vec3 sky_radiance(const ProbeVolumeView& volume, glm::vec3 direction);

/// Renders the scene in front of the sky. Returns the errors of `make_scene_light`.
[[nodiscard]] Result<ImageF> render_scene(const Scene& scene, const ProbeVolumeView& volume,
                                          const Camera& camera, const RenderSettings& settings,
                                          const LightmapsView& lightmaps = {});

}  // namespace tetralight
