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
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// Shades a scene with a volume's light: what an engine would show with this runtime. Static
/// surfaces take the probe light of each point, things that move (`contributes_gi` false) that of
/// their bounds' centre, or of a proxy volume around them where they ask for one; the volume's
/// lights that are not `Baked` add their direct term with shadow rays. Where probes hold the
/// occlusion of a light, it stands for the shadows of static things on moving ones, and only moving
/// things are asked by rays. Lights, and emission that the bake saw, are dimmed as the volume's
/// layers are.
class SceneShader {
  public:
    /// Keeps references. Error: not enough memory, or a proxy volume that cannot be made.
    [[nodiscard]] static Result<SceneShader> make(const Scene& scene, const ProbeVolumeView& volume,
                                                  ProbeLight probes = ProbeLight::AsTheScene);

    /// The same with light that is there. Error: not enough memory.
    [[nodiscard]] static Result<SceneShader> make(const Scene& scene, const ProbeVolumeView& volume,
                                                  SceneLight light);

    [[nodiscard]] std::span<const Lppv> proxy_volumes() const { return light_.proxy_volumes; }

    /// Radiance that leaves the first surface towards the ray's origin; none when nothing is hit.
    /// Also gives the distance.
    struct Shaded {
        glm::vec3 radiance{0.0f};
        float distance = 0.0f;
    };

    [[nodiscard]] std::optional<Shaded> shade(const glm::dvec3& origin, glm::vec3 direction) const;

    /// Distance to what `shade` would shade.
    [[nodiscard]] std::optional<float> distance(const glm::dvec3& origin,
                                                glm::vec3 direction) const;

    /// What casts a shadow.
    enum class Casters : bool { All, Moving };

    /// Whether the scene blocks the way from a world position.
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
    [[nodiscard]] glm::vec3 direct_term(const Surface& surface) const;

    const Scene* scene_;
    ProbeVolumeView volume_;
    SceneLight light_;  // its lights in render space
    TraceScene traced_;
    TraceScene moving_;
};

/// Light of the sky in a direction, as the volume's ambient probe knows it.
[[nodiscard]] glm::vec3 sky_radiance(const ProbeVolumeView& volume, glm::vec3 direction);

/// Renders the scene, with the sky behind it.
[[nodiscard]] Result<ImageF> render_scene(const Scene& scene, const ProbeVolumeView& volume,
                                          const Camera& camera, const RenderSettings& settings);

}  // namespace tetralight
