// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_metadata.h>

#include <nlohmann/json.hpp>

#include <tetralight/base/hex.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/lightmap_settings.h>
#include <tetralight/pipeline/scene_choice_record.h>
#include <tetralight/pipeline/value_record.h>

namespace tetralight {
namespace {

using LightmapJson = nlohmann::ordered_json;

LightmapJson recordable_settings(const BakeLightmapsSettings& settings) {
    LightmapJson json = LightmapJson::object();
    for_each_lightmap_setting(settings, [&](const char* name, const auto& member, Recorded record) {
        if (record != Recorded::Never) json[name] = value_record(member);
    });
    return json;
}

LightmapJson mask_lights(const Scene& scene, const LightingPlan& plan) {
    LightmapJson lights = LightmapJson::array();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const uint32_t channel = plan.light_states[i].channel;
        if (channel == kNoIndex) continue;
        lights.push_back({{"light", scene.light_names[i]}, {"channel", channel}});
    }
    return lights;
}

}  // namespace

std::string lightmap_metadata(const Scene& scene, const LightingPlan& plan,
                              const BakeLightmapsSettings& settings) {
    LightmapJson json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
    record_scene_choice(scene.choice, json);
    json.update(recordable_settings(settings));
    const LightmapJson defaults = recordable_settings({});
    for_each_lightmap_setting(settings, [&](const char* name, const auto&, Recorded record) {
        if (record == Recorded::WhenChanged && json[name] == defaults[name]) json.erase(name);
    });
    if (settings.lighting.mixed_lighting == MixedLighting::Shadowmask) {
        json["shadow_mask"] = mask_lights(scene, plan);
    }
    return json.dump();
}

void set_recorded_samples(std::string& metadata, uint64_t max_samples) {
    const LightmapJson recorded = LightmapJson::parse(metadata);
    LightmapJson json;
    // "max_samples" comes before "time_budget".
    for (const auto& [name, value] : recorded.items()) {
        if (name == "max_samples") continue;
        if (name != "time_budget") {
            json[name] = value;
        } else if (max_samples > 0) {
            json["max_samples"] = max_samples;
        }
    }
    metadata = json.dump();
}

}  // namespace tetralight
