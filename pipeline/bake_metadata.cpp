// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_metadata.h>

#include <nlohmann/json.hpp>
#include <type_traits>

#include <tetralight/base/hex.h>
#include <tetralight/base/json/check_metadata.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/bake_members.h>
#include <tetralight/pipeline/scene_choice_record.h>
#include <tetralight/pipeline/value_record.h>

namespace tetralight {
namespace {

using Json = nlohmann::ordered_json;

/// The settings that metadata may record, by name.
Json recordable(const BakeVolumeSettings& settings) {
    Json json = Json::object();
    for_each_bake_member(settings, [&](const char* name, const auto& member, Recorded recorded) {
        if (recorded != Recorded::Never) json[name] = value_record(member);
    });
    return json;
}

/// Those of them that metadata records.
Json recorded(const BakeVolumeSettings& settings) {
    Json json = recordable(settings);
    const Json defaults = recordable({});
    for_each_bake_member(settings, [&](const char* name, const auto&, Recorded recorded) {
        if (recorded == Recorded::WhenChanged && json[name] == defaults[name]) json.erase(name);
    });
    return json;
}

/// An empty object if the metadata is none.
Json parsed(std::string_view metadata) {
    return check_json_object(metadata) ? Json::parse(metadata) : Json::object();
}

/// Sets a member to its value in metadata. False if that is of another type.
template <class T>
bool read_value(const Json& value, T& member) {
    if constexpr (std::is_floating_point_v<T>) {
        if (!value.is_number()) return false;
        member = value.get<T>();
    } else if constexpr (std::is_enum_v<T>) {
        constexpr uint8_t kEnumeratorCount = 3;
        for (uint8_t i = 0; i < kEnumeratorCount; ++i) {
            if (value != name_of(static_cast<T>(i))) continue;
            member = static_cast<T>(i);
            return true;
        }
        return false;
    } else if constexpr (std::is_integral_v<T>) {
        if (!value.is_number_unsigned()) return false;
        const auto number = value.get<uint64_t>();
        member = static_cast<T>(number);
        return member == number;
    }
    return true;
}

}  // namespace

std::string bake_metadata(const Scene& scene, const BakeVolumeSettings& settings,
                          bool has_overrides, bool has_dering) {
    Json json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
    record_scene_choice(scene.choice, json);
    json.update(recorded(settings));
    if (has_overrides) json["adjustments"] = hex(adjustments_key(scene.probe_adjustments));
    if (has_dering) json["dering"] = name_of(settings.dering.window);
    return json.dump();
}

Result<BakeVolumeSettings> recorded_settings(std::string_view metadata) {
    BakeVolumeSettings settings;
    if (auto status = check_metadata(metadata); !status) return status.error();
    if (metadata.empty()) return settings;
    const Json json = Json::parse(metadata);
    Status status = Ok{};
    for_each_bake_member(settings, [&](const char* name, auto& member, Recorded recorded) {
        const auto found = json.find(name);
        if (recorded == Recorded::Never || found == json.end()) return;
        if (read_value(*found, member)) return;
        status = Error{ErrorCode::Corrupt, name, found->dump(),
                       str_cat("section \"metadata\": its ", name, " is ", found->dump())};
    });
    if (!status) return status.error();
    return settings;
}

bool was_relit(std::string_view metadata) {
    return parsed(metadata).contains("relit");
}

bool is_of_another_scene(std::string_view metadata, const Scene& scene) {
    const Json json = parsed(metadata);
    return json.contains("scene") && json["scene"] != hex(scene_key(scene));
}

}  // namespace tetralight
