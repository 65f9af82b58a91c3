// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/runtime/runtime_lights.h>

// How a volume lights a scene, as values. All renderers of the tree shade by it, so that their
// pictures agree: `SceneShader` traces rays with it, `render/gl` uploads it.

namespace tetralight {

/// Which objects take light from the probes.
enum class ProbeLight : uint8_t {
    AsTheScene,  ///< all; moving objects as their node says (`SceneNode::light_probes`)
    OnePlace,    ///< all; moving objects at the center of their bounds
    StillOnly,   ///< static objects only
    Nothing,     ///< none: direct light and emission remain
};

/// How the surface of one instance takes baked light.
enum class ProbeUse : uint32_t {
    Off,          ///< not at all
    Given,        ///< one value for the whole instance
    ProxyVolume,  ///< from a grid around it
    EachPoint,    ///< by a query at each point of its surface
    Lightmap,     ///< from its lightmap instead
};

/// How one instance of the scene is lit.
struct InstanceLight {
    ProbeUse use = ProbeUse::EachPoint;
    /// For `Given`.
    PackedSh light{};
    /// For `ProxyVolume`: index into `SceneLight::proxy_volumes`.
    uint32_t proxy_volume = kNoIndex;
    /// One a light: the fraction that the static scene lets through to this instance if it moves;
    /// else 1.
    std::vector<float> visibility;
};

struct SceneLight {
    /// Lights whose direct term renderers add, world space.
    std::vector<RuntimeLight> lights;
    /// One for each instance of the scene.
    std::vector<InstanceLight> instances;
    std::vector<Lppv> proxy_volumes;
    /// Of instances with `Lightmap`; empty if there are none.
    LightmapsView lightmaps{};
    /// One for each material: the weight of the volume's layer that holds its emission; 1 if the
    /// emission was not baked.
    std::vector<float> emission_weights;
};

/// Static objects that have a lightmap take their light from it; all others take it from probes.
/// `lightmaps` outlives the result. Returns the error of a proxy volume that cannot be made, whose
/// message names the node, and those of `check_lightmap_scene`.
[[nodiscard]] Result<SceneLight> make_scene_light(const Scene& scene, const ProbeVolumeView& volume,
                                                  ProbeLight probes,
                                                  const LightmapsView& lightmaps = {});

}  // namespace tetralight
