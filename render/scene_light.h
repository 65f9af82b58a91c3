// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/reflection/reflections.h>
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

/// How surfaces with normal maps take light from lightmaps.
enum class LightmapLight : uint8_t {
    Directional,  ///< on their mapped normals, if the lightmaps have section `light`
    Flat,         ///< on the normals without the map
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

/// How a light whose direct term is added reaches static surfaces that have a lightmap.
enum class LightmapShadow : uint8_t {
    RealTime,  ///< with real-time shadows of all objects
    Mask,      ///< the mask has the shadows of static objects; real-time shadows of moving ones
    InTexels,  ///< not: its light is in the texels; real-time shadows of moving objects darken them
};

struct SceneLight {
    /// Lights whose direct term renderers add, world space.
    std::vector<RuntimeLight> lights;
    /// One for each instance of the scene.
    std::vector<InstanceLight> instances;
    std::vector<Lppv> proxy_volumes;
    /// Of instances with `Lightmap`; empty if there are none.
    LightmapsView lightmaps{};
    /// True: the ambient occlusion of lightmaps darkens their light.
    bool has_ambient_occlusion = false;
    /// What white surfaces with `InTexels` reflect in the real-time shadow of the main sun, at
    /// least: radiance.
    glm::vec3 shadow_color{0.0f};
    LightmapLight lightmap_light = LightmapLight::Directional;
    /// What shiny surfaces reflect; without probes, nothing. Its owner outlives the light.
    ReflectionsView reflections{};
    /// False: the light of each cube comes from far away.
    bool has_box_projection = true;
    /// One for each material: the weight of the volume's layer that holds its emission; 1 if the
    /// emission was not baked.
    std::vector<float> emission_weights;
};

[[nodiscard]] LightmapShadow lightmap_shadow(const LightmapsView& lightmaps,
                                             const RuntimeLight& light) noexcept;

/// Static objects that have a lightmap take their light from it; all others take it from probes.
/// `lightmaps` outlives the result. The shadow color is the mean light of the volume's ambient
/// probe. Returns the error of a proxy volume that cannot be made, whose message names the node,
/// those of `check_lightmap_scene`, and invalid_argument (field "lightmaps") if lightmaps and
/// volume were baked for other mixed lighting, so that light would count twice or never.
[[nodiscard]] Result<SceneLight> make_scene_light(const Scene& scene, const ProbeVolumeView& volume,
                                                  ProbeLight probes,
                                                  const LightmapsView& lightmaps = {});

}  // namespace tetralight
