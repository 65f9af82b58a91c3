// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bake/scene/scene.h"
#include "bake/trace_scene.h"
#include "base/result.h"
#include "lppv/lppv.h"
#include "pipeline/image_renderer.h"
#include "probes/packed_sh.h"
#include "probes/probe_volume.h"
#include "runtime/runtime_lights.h"

namespace tetralight {

/// Where things that move take their probe light from.
enum class MoverLight : uint8_t {
    AsTheScene,  ///< as each asks: `SceneNode::light_probes`
    OnePlace,    ///< all from the centre of their bounds
};

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
                                                  MoverLight movers = MoverLight::AsTheScene);

    /// The proxy volumes of the scene's objects.
    [[nodiscard]] std::span<const Lppv> proxy_volumes() const { return proxy_volumes_; }

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
    [[nodiscard]] bool is_blocked(const glm::dvec3& origin, glm::vec3 direction, float distance,
                                  Casters casters = Casters::All) const;

  private:
    SceneShader(const Scene& scene, const ProbeVolumeView& volume, TraceScene traced,
                TraceScene moving);

    /// A light in traced space, and what each instance that moves sees of it.
    struct DirectLight {
        RuntimeLight light;
        std::vector<float> visibility_of_mover;
    };

    void light_movers();
    void find_emission_weights();

    [[nodiscard]] const TraceScene& casters(Casters casters) const {
        return casters == Casters::All ? traced_ : moving_;
    }

    /// Back faces of single-sided materials are culled, as rasterizers do.
    [[nodiscard]] std::optional<Surface> first_front_face(glm::vec3 origin,
                                                          glm::vec3 direction) const;
    [[nodiscard]] PackedSh probe_light(const Surface& surface) const;
    [[nodiscard]] glm::vec3 direct_term(const Surface& surface) const;
    [[nodiscard]] Status add_proxy_volumes();

    const Scene* scene_;
    ProbeVolumeView volume_;
    TraceScene traced_;
    TraceScene moving_;
    std::vector<PackedSh> light_of_mover_;  // by instance
    std::vector<Lppv> proxy_volumes_;
    std::vector<uint32_t> proxy_of_mover_;  // by instance; kNoIndex: none
    std::vector<DirectLight> direct_lights_;
    std::vector<float> emission_weights_;  // by material
};

/// Light of the sky in a direction, as the volume's ambient probe knows it.
[[nodiscard]] glm::vec3 sky_radiance(const ProbeVolumeView& volume, glm::vec3 direction);

/// Renders the scene, with the sky behind it.
[[nodiscard]] Result<ImageF> render_scene(const Scene& scene, const ProbeVolumeView& volume,
                                          const Camera& camera, const RenderSettings& settings);

}  // namespace tetralight
