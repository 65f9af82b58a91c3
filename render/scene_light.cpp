// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/scene_light.h>

#include <numbers>
#include <utility>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/lightmap_scene.h>
#include <tetralight/pipeline/lppv_object.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

/// Grid points a metre in proxy volumes.
constexpr double kProxyDensity = 3.0;

InstanceLight light_of_moving(const glm::dvec3& anchor, const ProbeVolumeView& volume,
                              const std::vector<RuntimeLight>& lights) {
    const CellLocation location = locate(volume, glm::vec3(anchor));
    InstanceLight result{
        ProbeUse::Given, pack_sh(interpolate(volume, location).irradiance), kNoIndex, {}};
    for (const RuntimeLight& light : lights) {
        result.visibility.push_back(interpolate_visibility(volume, location, light));
    }
    return result;
}

/// Where a moving object queries the probes: at its anchor, else at the center of its bounds.
glm::dvec3 light_anchor(const Scene& scene, const MeshInstance& instance, const WorldBox& bounds) {
    if (instance.node == kNoIndex) return bounds.center();
    const uint32_t anchor = scene.nodes[instance.node].probe_anchor;
    if (anchor == kNoIndex) return bounds.center();
    return glm::dvec3(scene.nodes[anchor].world_from_node[3]);
}

bool takes_no_probes(const Scene& scene, const MeshInstance& instance) {
    return instance.node != kNoIndex &&
           scene.nodes[instance.node].light_probes == LightProbeUsage::Off;
}

/// Emission that was not baked keeps a weight of 1.
std::vector<float> find_emission_weights(const Scene& scene, const ProbeVolumeView& volume) {
    std::vector<float> weights(scene.materials.size(), 1.0f);
    if (volume.layers.empty()) return weights;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (!material.bakes_emission) continue;
        uint32_t layer = find_layer(volume, "material:" + material.name);
        if (layer == kNoIndex) layer = find_layer(volume, "emission");
        if (layer == kNoIndex) layer = find_layer(volume, "rest");
        if (layer < volume.layers.size()) weights[i] = volume.layers[layer].weight;
    }
    return weights;
}

Status add_proxy_volumes(const Scene& scene, const ProbeVolumeView& volume, SceneLight& light) {
    for (const SceneObject& object : find_proxy_objects(scene)) {
        LppvSettings settings;
        settings.density = kProxyDensity;
        const auto grid = make_object_grid(object, settings);
        if (!grid) return grid.error();
        auto lppv = make_lppv(volume, *grid, {});
        if (!lppv) return lppv.error();
        for (const uint32_t index : object.instances) {
            if (scene.instances[index].contributes_gi) continue;
            light.instances[index].use = ProbeUse::ProxyVolume;
            light.instances[index].proxy_volume = static_cast<uint32_t>(light.proxy_volumes.size());
        }
        light.proxy_volumes.push_back(std::move(*lppv));
    }
    return Ok{};
}

/// Of mixed lights alone does the mode change what is baked.
Status check_mixed_lighting(const ProbeVolumeView& volume, const LightmapsView& lightmaps) {
    for (size_t i = 0; i < volume.lights.size(); ++i) {
        const LightState state =
            i < volume.light_states.size() ? volume.light_states[i] : LightState{};
        const bool is_mixed = volume.lights[i].mode == LightMode::Mixed || state.fell_back != 0;
        if (!is_mixed || state.mixed_lighting == lightmaps.info.mixed_lighting) continue;
        const char* of_maps = name_of(lightmaps.info.mixed_lighting);
        return Error{ErrorCode::InvalidArgument, "lightmaps", of_maps,
                     str_cat("the lightmaps were baked with --mixed-lighting ", of_maps,
                             " and the probes with ", name_of(state.mixed_lighting),
                             "; bake both for the same")};
    }
    return Ok{};
}

/// What a white surface reflects of the ambient light, in the mean of all normals.
glm::vec3 mean_ambient(const ProbeVolumeView& volume) {
    constexpr float kY0 = 0.28209479f;
    const glm::vec3 irradiance = kY0 * volume.info.ambient.coefficients[0];
    return glm::max(irradiance * std::numbers::inv_pi_v<float>, glm::vec3(0.0f));
}

void use_lightmaps(const Scene& scene, const LightmapsView& lightmaps, SceneLight& light) {
    light.lightmaps = lightmaps;
    for (size_t i = 0; i < lightmaps.rectangles.size(); ++i) {
        const bool has_page = lightmaps.rectangles[i].page != kNoIndex;
        if (has_page && scene.instances[i].contributes_gi)
            light.instances[i].use = ProbeUse::Lightmap;
    }
}

}  // namespace

LightmapShadow lightmap_shadow(const LightmapsView& lightmaps, const RuntimeLight& light) noexcept {
    if (light.light.mode != LightMode::Mixed) return LightmapShadow::RealTime;
    if (lightmaps.info.mixed_lighting == MixedLighting::Subtractive)
        return LightmapShadow::InTexels;
    const bool has_mask = light.channel < 4 && !lightmaps.shadow_mask.empty();
    return has_mask ? LightmapShadow::Mask : LightmapShadow::RealTime;
}

Result<SceneLight> make_scene_light(const Scene& scene, const ProbeVolumeView& volume,
                                    ProbeLight probes, const LightmapsView& lightmaps) {
    const bool has_lightmaps = lightmaps.info.page_count > 0;
    if (has_lightmaps) {
        if (auto status = check_lightmap_scene(lightmaps, scene); !status) return status.error();
        if (auto status = check_mixed_lighting(volume, lightmaps); !status) return status.error();
    }
    SceneLight light;
    light.lights = runtime_lights(volume);
    light.shadow_color = mean_ambient(volume);
    light.emission_weights = find_emission_weights(scene, volume);
    const bool lights_moving = probes == ProbeLight::AsTheScene || probes == ProbeLight::OnePlace;
    for (const MeshInstance& instance : scene.instances) {
        InstanceLight& lit = light.instances.emplace_back();
        const auto bounds = instance_bounds(scene, instance);
        if (!instance.contributes_gi && bounds) {
            lit = light_of_moving(light_anchor(scene, instance, *bounds), volume, light.lights);
            if (takes_no_probes(scene, instance)) lit.light = pack_sh(volume.info.ambient);
            if (!lights_moving) lit.use = ProbeUse::Off;
        }
        if (probes == ProbeLight::Nothing) lit.use = ProbeUse::Off;
        lit.visibility.resize(light.lights.size(), 1.0f);
    }
    if (probes == ProbeLight::AsTheScene) {
        if (auto status = add_proxy_volumes(scene, volume, light); !status) return status.error();
    }
    if (has_lightmaps) use_lightmaps(scene, lightmaps, light);
    return light;
}

}  // namespace tetralight
