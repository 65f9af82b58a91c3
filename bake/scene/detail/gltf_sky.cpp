// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_sky.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// The value that a string holds as JSON; the string itself if it holds none.
json unquoted(const json& value) {
    if (!value.is_string()) return value;
    const auto& text = value.get_ref<const std::string&>();
    if (!check_json_shape(text)) return value;
    json parsed = json::parse(text, nullptr, false);
    return parsed.is_discarded() ? value : parsed;
}

json expanded(const json& sky) {
    json value = unquoted(sky);
    if (value.is_number()) return {{"radiance", {value, value, value}}};
    if (read_vec3(value)) return {{"radiance", std::move(value)}};
    return value;
}

}  // namespace

Status expand_skies(json& document) {
    const auto scenes = document.find("scenes");
    if (scenes == document.end() || !scenes->is_array()) return Ok{};
    for (size_t i = 0; i < scenes->size(); ++i) {
        json& scene = (*scenes)[i];
        if (!scene.is_object() || !scene.contains("extras")) continue;
        json& extras = scene["extras"];
        if (!extras.is_object() || !extras.contains("sky")) continue;
        json& sky = extras["sky"];
        json object = expanded(sky);
        const auto radiance = object.is_object() ? object.find("radiance") : object.end();
        if (!object.is_object() || radiance == object.end() || !read_vec3(*radiance)) {
            return Error{ErrorCode::Corrupt, str_cat("scenes[", i, "].extras.sky"), shown_json(sky),
                         str_cat("scene ", i, ": extras.sky is ", shown_json(sky),
                                 "; write {\"radiance\": [r, g, b]}")};
        }
        sky = std::move(object);
    }
    return Ok{};
}

}  // namespace tetralight::detail
