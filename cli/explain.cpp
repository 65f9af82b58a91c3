// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/explain.h>

#include <algorithm>

#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/light_words.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/cli/table.h>
#include <tetralight/runtime/runtime_lights.h>

namespace tetralight::cli {
namespace {

/// What the runtime adds of a light.
std::string runtime_part(const std::vector<RuntimeLight>& lights, size_t index) {
    const auto light =
        std::ranges::find(lights, static_cast<uint32_t>(index), &RuntimeLight::index);
    if (light == lights.end()) return "nothing";
    if (!light->lights_moving) return "nothing on what moves";
    return light->channel != kNoIndex ? "direct × occlusion, shadows of what moves"
                                      : "direct, shadows of everything";
}

std::string layer_name(const LightingPlan& plan, uint32_t layer) {
    return layer < plan.layer_names.size() ? plan.layer_names[layer] : "";
}

Json source_json(const std::string& name, const std::string& type, const std::string& mode,
                 const BakedTerms& terms) {
    return {{"name", name},
            {"type", type},
            {"mode", mode},
            {"direct_in_probes", terms.has_direct},
            {"bounces_in_probes", terms.has_bounces}};
}

Json light_json(const Scene& scene, const LightingPlan& plan, size_t i) {
    const Light& light = plan.lights[i];
    const LightState& state = plan.light_states[i];
    Json json = source_json(scene.light_names[i], name_of(light.type), name_of(light.mode),
                            baked_terms(light.mode, state.mixed_lighting));
    json["occlusion_channel"] = state.channel == kNoIndex ? Json() : Json(state.channel);
    json["fell_back"] = state.fell_back != 0;
    json["layer"] = layer_name(plan, state.layer);
    return json;
}

/// Sky and materials, which are baked in every mode.
Json constant_json(const LightingPlan& plan, const std::string& name, const std::string& type,
                   uint32_t layer) {
    Json json = source_json(name, type, "baked", {.has_direct = true, .has_bounces = true});
    const auto rest = plan.has_rest() ? plan.bake.layer_count : kNoIndex;
    json["occlusion_channel"] = nullptr;
    json["fell_back"] = false;
    json["layer"] = layer_name(plan, std::min(layer, rest));
    json["runtime"] = "nothing";
    return json;
}

Json sources_json(const Scene& scene, const LightingPlan& plan) {
    Json sources = Json::array();
    ProbeVolume volume;
    volume.lights = plan.lights;
    volume.light_states = plan.light_states;
    const std::vector<RuntimeLight> added = runtime_lights(volume.view());
    for (size_t i = 0; i < plan.lights.size(); ++i) {
        sources.push_back(light_json(scene, plan, i));
        sources.back()["runtime"] = runtime_part(added, i);
    }
    if (scene.environment.radiance != glm::vec3(0.0f)) {
        sources.push_back(constant_json(plan, "sky", "sky", plan.bake.layer_of_sky));
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        const bool shines =
            material.bakes_emission && emission_source(material).factor != glm::vec3(0.0f);
        const uint32_t layer = plan.bake.layer_of(plan.bake.layer_of_material, i);
        if (shines) sources.push_back(constant_json(plan, material.name, "material", layer));
    }
    return sources;
}

std::string yes(const Json& flag) {
    return flag.get<bool>() ? "yes" : "-";
}

std::string table_of(const Json& sources) {
    std::vector<std::vector<std::string>> rows{
        {"source", "type", "mode", "direct", "bounces", "occlusion", "layer", "added at run time"}};
    for (const Json& source : sources) {
        const Json& channel = source["occlusion_channel"];
        const std::string layer = source["layer"];
        const std::string mode = source["mode"];
        rows.push_back({printable(source["name"]), source["type"],
                        source["fell_back"].get<bool>() ? mode + " (no channel left)" : mode,
                        yes(source["direct_in_probes"]), yes(source["bounces_in_probes"]),
                        channel.is_null() ? "-" : str_cat("channel ", channel.get<uint32_t>()),
                        layer.empty() ? "-" : printable(layer), source["runtime"]});
    }
    std::string lines = aligned(rows, "llllllll");
    if (!lines.empty()) lines.pop_back();
    return lines;
}

}  // namespace

Status explain(const Scene& scene, const LightingSettings& settings, const CommonOptions& common) {
    const auto plan = plan_lighting(scene, settings);
    if (!plan) return plan.error();
    common.warn(plan->warnings);
    const Json sources = sources_json(scene, *plan);
    const std::string mode = name_of(settings.mixed_lighting);
    size_t probe_count = 0;
    for (const ProbeGroup& group : scene.probe_groups) probe_count += group.positions.size();
    common.print(
        {{"mixed_lighting", mode},
         {"sources", sources},
         {"triangles", estimate_bake_memory(scene, 0).triangle_count},
         {"instances", scene.instances.size()},
         {"probe_groups", scene.probe_groups.size()},
         {"probes", probe_count},
         {"parts", parts_json(scene.parts)}},
        str_cat(parts_text(scene.parts), "mixed lighting: ", mode, "\n", table_of(sources)));
    return Ok{};
}

}  // namespace tetralight::cli
