// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_extras.h>

#include <limits>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/json_members.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// "(not a string)" for a value of another type: who reads the words refuses it.
std::optional<std::string> word_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    if (found == nullptr) return std::nullopt;
    return found->is_string() ? found->get<std::string>() : std::string("(not a string)");
}

/// NaN for a value of another type.
std::optional<double> optional_number_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    if (found == nullptr) return std::nullopt;
    return found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::optional<uint32_t> rendering_layers_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    if (found == nullptr) return std::nullopt;
    const auto mask = read_rendering_layers(*found, path);
    return mask ? std::optional(*mask) : std::nullopt;
}

std::optional<GltfAdjustment> adjustment_from(const json& node) {
    const json* value = find_json(node, "extras/probe_adjustment");
    if (value == nullptr) return std::nullopt;
    GltfAdjustment result;
    result.shape = string_at(*value, "shape");
    if (value->contains("size")) result.size = vec3_at(*value, "size", glm::dvec3(0.0));
    result.radius = optional_number_at(*value, "radius");
    result.forbid = boolean_at(*value, "forbid");
    result.spacing = optional_number_at(*value, "spacing");
    result.validity = optional_number_at(*value, "validity");
    result.intensity = optional_number_at(*value, "intensity");
    result.rendering_layers = rendering_layers_at(*value, "rendering_layers");
    return result;
}

/// An object, or `true` for one without members.
std::optional<GltfReflectionProbe> reflection_probe_from(const json& node) {
    const json* value = find_json(node, "extras/reflection_probe");
    if (value == nullptr) return std::nullopt;
    if (!value->is_object() && !boolean_at(*value, "").value_or(false)) return std::nullopt;
    GltfReflectionProbe result;
    result.size = vec3_at(*value, "size", result.size);
    result.center = vec3_at(*value, "center", result.center);
    result.blend_distance = number_at(*value, "blend_distance", result.blend_distance);
    if (const json* importance = find_json(*value, "importance")) {
        result.importance = read_int32(*importance).value_or(result.importance);
    }
    result.near_distance = number_at(*value, "near", result.near_distance);
    return result;
}

}  // namespace

void read_node_extras(const json& node, GltfNode& result) {
    result.contributes_gi = boolean_at(node, "extras/contribute_gi");
    result.is_walkable = boolean_at(node, "extras/walkable");
    result.is_in_reflections = boolean_at(node, "extras/in_reflections");
    result.receive_gi = word_at(node, "extras/receive_gi");
    result.lightmap_scale = optional_number_at(node, "extras/lightmap_scale");
    result.stitches_seams = boolean_at(node, "extras/stitch_seams");
    result.light_probes = word_at(node, "extras/light_probes");
    result.probe_anchor = word_at(node, "extras/probe_anchor");
    result.is_probe_group = boolean_at(node, "extras/light_probe_group").value_or(false);
    if (find_json(node, "extras/probe_resolution") != nullptr)
        result.probe_resolution = vec3_at(node, "extras/probe_resolution", glm::dvec3(0.0));
    result.dering = boolean_at(node, "extras/dering").value_or(false);
    result.rendering_layers = rendering_layers_at(node, "extras/rendering_layers");
    result.probe_adjustment = adjustment_from(node);
    result.reflection_probe = reflection_probe_from(node);
    const auto portal = numbers_at(node, "extras/portal");
    if (!portal.empty()) result.portal = {portal[0], portal[1]};
}

GltfLightExtras light_extras_from(const json& element) {
    GltfLightExtras result;
    result.mode = word_at(element, "extras/mode");
    result.falloff = word_at(element, "extras/falloff");
    result.shape = word_at(element, "extras/shape");
    result.indirect_multiplier = optional_number_at(element, "extras/indirect_multiplier");
    result.radius = optional_number_at(element, "extras/radius");
    result.angle_degrees = optional_number_at(element, "extras/angle");
    result.width = optional_number_at(element, "extras/width");
    result.height = optional_number_at(element, "extras/height");
    return result;
}

std::optional<std::string> bake_emission_from(const json& material) {
    constexpr std::string_view kPath = "extras/bake_emission";
    const json* value = find_json(material, kPath);
    if (value == nullptr) return std::nullopt;
    if (value->is_string()) return value->get<std::string>();
    if (*value == true || *value == 1) return "baked";
    if (*value == false || *value == 0) return "none";
    return "(not a string)";
}

}  // namespace tetralight::detail
