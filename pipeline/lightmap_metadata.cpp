// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_metadata.h>

#include <nlohmann/json.hpp>

#include <tetralight/base/hex.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/lightmap_settings.h>
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

}  // namespace

std::string lightmap_metadata(const Scene& scene, const BakeLightmapsSettings& settings) {
    LightmapJson json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
    json.update(recordable_settings(settings));
    const LightmapJson defaults = recordable_settings({});
    for_each_lightmap_setting(settings, [&](const char* name, const auto&, Recorded record) {
        if (record == Recorded::WhenChanged && json[name] == defaults[name]) json.erase(name);
    });
    return json.dump();
}

}  // namespace tetralight
