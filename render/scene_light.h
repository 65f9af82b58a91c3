// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/runtime/runtime_lights.h>

// How a volume lights a scene, as values: what every renderer of ours shades by, so that their
// pictures agree. `SceneShader` traces rays with it, `runtime/gl` uploads it.

namespace tetralight {

/// Who takes light from the probes.
enum class ProbeLight : uint8_t {
    AsTheScene,  ///< everything; things that move as each asks: `SceneNode::light_probes`
    OnePlace,    ///< everything; things that move all from the centre of their bounds
    StillOnly,   ///< what stands still alone
    Nothing,     ///< nothing: the lights' direct terms and emission are left
};

/// Where the surface of one instance takes its probe light from.
enum class ProbeUse : uint32_t {
    Off,          ///< none
    Given,        ///< one for the whole instance
    ProxyVolume,  ///< a grid around it
    EachPoint,    ///< a query at each point of its surface
};

/// Probe light of points of still surfaces is looked up this far off them, so that a wall takes
/// less of the light behind it.
inline constexpr float kProbeNormalBias = 0.4f;

/// How one instance of the scene is lit.
struct InstanceLight {
    ProbeUse use = ProbeUse::EachPoint;
    /// With `Given`.
    PackedSh light{};
    /// With `ProxyVolume`: index into `SceneLight::proxy_volumes`.
    uint32_t proxy_volume = kNoIndex;
    /// One a light: what the static scene lets through to this instance, if it moves; else 1.
    std::vector<float> visibility;
};

struct SceneLight {
    /// Those whose direct term renderers add, world space.
    std::vector<RuntimeLight> lights;
    /// One an instance of the scene.
    std::vector<InstanceLight> instances;
    std::vector<Lppv> proxy_volumes;
    /// One a material: emission that the bake saw is dimmed as the volume's layers are.
    std::vector<float> emission_weights;
};

/// Error: a proxy volume that cannot be made; it names the node.
[[nodiscard]] Result<SceneLight> make_scene_light(const Scene& scene, const ProbeVolumeView& volume,
                                                  ProbeLight probes);

}  // namespace tetralight
