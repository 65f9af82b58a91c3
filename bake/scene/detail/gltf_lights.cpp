// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_lights.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_light_extras.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::optional<LightType> type_from(const std::string& type) {
    if (type == "directional") return LightType::Directional;
    if (type == "point") return LightType::Point;
    if (type == "spot") return LightType::Spot;
    return std::nullopt;
}

Status read_intensity(const GltfLight& source, Light& light) {
    if (source.intensity < 0.0) {
        return Error{ErrorCode::Corrupt, ".intensity", str_cat(source.intensity),
                     str_cat("intensity ", source.intensity, " is negative")};
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double color = source.color[channel];
        if (color < 0.0) {
            return Error{ErrorCode::Corrupt, str_cat(".color[", channel, "]"), str_cat(color),
                         str_cat("color ", color, " is negative")};
        }
        light.intensity[channel] = static_cast<float>(color * source.intensity);
        if (std::isfinite(light.intensity[channel])) continue;
        return Error{ErrorCode::Corrupt, ".intensity", str_cat(source.intensity),
                     str_cat("intensity is not finite (", color, " * ", source.intensity, ")")};
    }
    return Ok{};
}

Status read_range(const GltfLight& source, Light& light) {
    light.range = static_cast<float>(source.range);
    if (source.range >= 0.0 && std::isfinite(light.range)) return Ok{};
    return Error{ErrorCode::Corrupt, ".range", str_cat(source.range),
                 str_cat("range ", source.range, " is negative or too large")};
}

/// Accepts what exporters write: equal angles for a cone with a hard edge, and a right angle that
/// is rounded up to a float.
Status read_cone(const GltfLight& source, Light& light) {
    constexpr double kRightAngle = std::numbers::pi / 2.0;
    constexpr double kRounding = 1e-6;
    const double inner = source.inner_cone_radians;
    const double outer = source.outer_cone_radians;
    const bool is_cone = inner >= 0.0 && inner <= outer && outer > 0.0;
    if (!is_cone || outer > kRightAngle + kRounding) {
        return Error{ErrorCode::Corrupt, ".spot", str_cat(inner, ", ", outer),
                     str_cat("cone angles ", inner, " and ", outer,
                             " are not 0 <= inner <= outer <= pi / 2")};
    }
    light.cos_inner_cone = static_cast<float>(std::cos(std::min(inner, kRightAngle)));
    light.cos_outer_cone = static_cast<float>(std::cos(std::min(outer, kRightAngle)));
    return Ok{};
}

/// The node's X axis, without what of it is along Z; 0 if there is none.
glm::dvec3 tangent_from(const glm::dmat4& world_from_node) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(world_from_node[2]));
    const glm::dvec3 x(world_from_node[0]);
    return x - forward * glm::dot(forward, x);
}

/// What a light does not have on a node that is scaled to 0; null if it has all that it needs.
const char* missing_axis(const glm::dmat4& world_from_node, LightType type) {
    if (type == LightType::Point) return nullptr;
    if (glm::dvec3(world_from_node[2]) == glm::dvec3(0.0)) return "direction";
    const bool has_width =
        type != LightType::Rectangle || glm::length(tangent_from(world_from_node)) > 0.0;
    return has_width ? nullptr : "width";
}

/// Lights shine along their node's −Z; a rectangle's width is along its X. The node's scale and
/// mirroring have no effect (KHR_lights_punctual). Precondition: no axis is missing.
Status place_light(const glm::dmat4& world_from_node, Light& light) {
    light.position = glm::vec3(world_from_node[3]);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::isfinite(light.position[axis])) continue;
        return Error{ErrorCode::Corrupt,
                     str_cat("position is too far away (", world_from_node[3][axis], ")")};
    }
    if (light.type == LightType::Point) return Ok{};
    const glm::dvec3 direction = -glm::dvec3(world_from_node[2]);
    const double length = glm::length(direction);
    if (!std::isfinite(length)) {
        return Error{ErrorCode::Corrupt,
                     str_cat("direction is undefined: its node is scaled to ", length)};
    }
    light.direction = glm::vec3(direction / length);
    if (light.type == LightType::Rectangle) {
        light.tangent = glm::vec3(glm::normalize(tangent_from(world_from_node)));
    }
    return Ok{};
}

/// Without a place if an axis is missing.
Result<Light> read_light(const GltfLight& source, LightType type, const GltfWorldNode& placed,
                         const GltfNode& node) {
    Light light;
    light.type = type;
    if (const auto status = read_intensity(source, light); !status) return status.error();
    if (const auto status = read_range(source, light); !status) return status.error();
    if (type == LightType::Spot) {
        if (const auto status = read_cone(source, light); !status) return status.error();
    }
    const std::string node_member = str_cat("nodes[", placed.node, "]");
    const auto extras = merged_extras(node.light_extras, source.extras);
    Light alone = light;
    if (const auto status = apply_light_extras(extras, light); !status) {
        const auto of_node = apply_light_extras(node.light_extras, alone);
        const bool is_of_node = !of_node && of_node.error().field == status.error().field;
        return is_of_node ? in_member(status.error(), node_member) : status.error();
    }
    if (missing_axis(placed.world_from_node, light.type) != nullptr) return light;
    if (const auto status = place_light(placed.world_from_node, light); !status) {
        return in_member(status.error(), node_member);
    }
    return light;
}

}  // namespace

Result<GltfLights> read_lights(const GltfDocument& document, std::span<const GltfWorldNode> nodes) {
    GltfLights result;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (node.light == kNoIndex || !placed.is_visible) continue;
        const GltfLight& source = document.lights[node.light];
        const std::string place = gltf_place("light", node.light, source.name);
        const auto type = type_from(source.type);
        if (!type) {
            result.warnings.push_back(
                str_cat(place, ": type \"", source.type, "\" is not known; left out"));
            continue;
        }
        const auto light = read_light(source, *type, placed, node);
        if (!light) {
            const Error error = in_element(light.error(), "lights", node.light, source.name);
            return in_element(error, "nodes", placed.node, node.name);
        }
        if (const char* missing = missing_axis(placed.world_from_node, light->type)) {
            result.warnings.push_back(str_cat(gltf_place("node", placed.node, node.name),
                                              ": is scaled to 0, so that its light has no ",
                                              missing, "; left out"));
            continue;
        }
        result.lights.push_back(*light);
        result.names.push_back(node.name.empty() ? source.name : node.name);
    }
    return result;
}

}  // namespace tetralight::detail
