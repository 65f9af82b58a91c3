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

std::optional<LightType> area_type_from(const std::string& type) {
    if (type == "rect") return LightType::Rectangle;
    if (type == "disk") return LightType::Disc;
    return std::nullopt;
}

void leave_out_unknown_type(const std::string& type, const std::string& place, PartList& parts) {
    parts.add_left_out("lights of unknown type",
                       str_cat("type \"", type, "\" is not known; left out"), true, place);
}

/// Sets colour times intensity times `factor`, which is 1 or the area of a light in m².
Status set_intensity(const glm::dvec3& color, double intensity, double factor, Light& light) {
    if (intensity < 0.0) {
        return Error{ErrorCode::Corrupt, ".intensity", str_cat(intensity),
                     str_cat("intensity ", intensity, " is negative")};
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double value = color[channel];
        if (value < 0.0) {
            return Error{ErrorCode::Corrupt, str_cat(".color[", channel, "]"), str_cat(value),
                         str_cat("color ", value, " is negative")};
        }
        light.intensity[channel] = static_cast<float>(value * intensity * factor);
        if (std::isfinite(light.intensity[channel])) continue;
        return Error{ErrorCode::Corrupt, ".intensity", str_cat(intensity),
                     str_cat("intensity is not finite (", value, " * ", intensity, ")")};
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

/// Applies extras and, unless an axis is missing, the node's transform. A field is that of the node
/// where the node is at fault.
Status finish_light(const GltfLightExtras& of_node, const GltfLightExtras& of_light,
                    const GltfWorldNode& placed, Status (*apply)(const GltfLightExtras&, Light&),
                    Light& light) {
    const std::string node_member = str_cat("nodes[", placed.node, "]");
    Light alone = light;
    if (const auto status = apply(merged_extras(of_node, of_light), light); !status) {
        const auto without_light = apply(of_node, alone);
        const bool is_of_node =
            !without_light && without_light.error().field == status.error().field;
        return is_of_node ? in_member(status.error(), node_member) : status.error();
    }
    if (missing_axis(placed.world_from_node, light.type) != nullptr) return Ok{};
    if (const auto status = place_light(placed.world_from_node, light); !status) {
        return in_member(status.error(), node_member);
    }
    return Ok{};
}

Result<Light> read_light(const GltfLight& source, LightType type, const GltfWorldNode& placed,
                         const GltfNode& node) {
    Light light;
    light.type = type;
    const auto intensity = set_intensity(source.color, source.intensity, 1.0, light);
    if (!intensity) return intensity.error();
    if (const auto status = read_range(source, light); !status) return status.error();
    if (type == LightType::Spot) {
        if (const auto status = read_cone(source, light); !status) return status.error();
    }
    const auto status =
        finish_light(node.light_extras, source.extras, placed, apply_light_extras, light);
    if (!status) return status.error();
    return light;
}

/// The largest scale along an axis of a node, by which EXT_lights_area scales lights.
double largest_axis(const glm::dmat4& world_from_node) {
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, glm::length(glm::dvec3(world_from_node[axis])));
    return largest;
}

/// Metres along a side of an area light.
Result<float> side_from(double value, double scale, const char* member) {
    const auto side = static_cast<float>(value * scale);
    if (value > 0.0 && side > 0.0f && std::isfinite(side)) return side;
    return Error{ErrorCode::Corrupt, str_cat(".", member), str_cat(value),
                 str_cat(member, " ", value, " makes a light of ", value * scale, " m")};
}

Status set_sides(const GltfAreaLight& source, double scale, Light& light) {
    const auto size = side_from(source.size, scale, "size");
    if (!size) return size.error();
    if (light.type == LightType::Disc) {
        light.radius = *size / 2.0f;
        return Ok{};
    }
    const auto width = side_from(source.aspect, *size, "rect.aspect");
    if (!width) return width.error();
    light.width = *width;
    light.height = *size;
    return Ok{};
}

/// What EXT_lights_area says a light has that does not say it, in cd/m².
constexpr double kDefaultLuminance = 1000.0;

/// Radiance is intensity over area (probes/light.h).
Result<Light> read_area_light(const GltfAreaLight& source, LightType type,
                              const GltfWorldNode& placed, const GltfNode& node) {
    Light light;
    light.type = type;
    const double scale = largest_axis(placed.world_from_node);
    if (const auto status = set_sides(source, scale, light); !status) return status.error();
    const auto intensity = set_intensity(source.color, source.intensity.value_or(kDefaultLuminance),
                                         light_area(light), light);
    if (!intensity) return intensity.error();
    const auto status =
        finish_light(node.light_extras, source.extras, placed, apply_area_light_extras, light);
    if (!status) return status.error();
    return light;
}

/// Adds a part, and returns true, if a light lacks an axis on a node that is scaled to 0.
bool is_left_out(const GltfNode& node, const GltfWorldNode& placed, LightType type,
                 GltfLights& lights) {
    const char* missing = missing_axis(placed.world_from_node, type);
    if (missing == nullptr) return false;
    lights.parts.add_left_out("lights scaled to 0", str_cat("have no ", missing, "; left out"),
                              true, gltf_place("node", placed.node, node.name));
    return true;
}

/// Adds the light of KHR_lights_punctual of a node, if it has one.
Status add_punctual_light(const GltfDocument& document, const GltfWorldNode& placed,
                          GltfLights& lights) {
    const GltfNode& node = document.nodes[placed.node];
    if (node.light == kNoIndex) return Ok{};
    const GltfLight& source = document.lights[node.light];
    const auto type = type_from(source.type);
    if (!type) {
        leave_out_unknown_type(source.type, gltf_place("light", node.light, source.name),
                               lights.parts);
        return Ok{};
    }
    const auto light = read_light(source, *type, placed, node);
    if (!light) return in_element(light.error(), "lights", node.light, source.name);
    if (is_left_out(node, placed, light->type, lights)) return Ok{};
    lights.lights.push_back(*light);
    lights.names.push_back(node.name.empty() ? source.name : node.name);
    return Ok{};
}

/// Adds the light of EXT_lights_area of a node, if it has one.
Status add_area_light(const GltfDocument& document, const GltfWorldNode& placed,
                      GltfLights& lights) {
    const GltfNode& node = document.nodes[placed.node];
    if (node.area_light == kNoIndex) return Ok{};
    const GltfAreaLight& source = document.area_lights[node.area_light];
    const auto type = area_type_from(source.type);
    if (!type) {
        leave_out_unknown_type(source.type, gltf_place("area light", node.area_light, source.name),
                               lights.parts);
        return Ok{};
    }
    if (is_left_out(node, placed, *type, lights)) return Ok{};
    const auto light = read_area_light(source, *type, placed, node);
    if (!light) return in_element(light.error(), "area lights", node.area_light, source.name);
    if (!source.intensity) {
        lights.parts.add({PartUse::Approximated,
                          "area lights without intensity",
                          0,
                          {},
                          str_cat("none stands for ", kDefaultLuminance,
                                  " cd/m² in EXT_lights_area, and for 1 in files of Babylon.js"),
                          "give them an intensity",
                          true},
                         gltf_place("area light", node.area_light, source.name));
    }
    lights.lights.push_back(*light);
    lights.names.push_back(node.name.empty() ? source.name : node.name);
    return Ok{};
}

}  // namespace

Result<GltfLights> read_lights(const GltfDocument& document, std::span<const GltfWorldNode> nodes) {
    GltfLights result;
    for (const GltfWorldNode& placed : nodes) {
        if (!placed.is_visible) continue;
        for (const auto& add : {add_punctual_light, add_area_light}) {
            const auto status = add(document, placed, result);
            if (status) continue;
            return in_element(status.error(), "nodes", placed.node,
                              document.nodes[placed.node].name);
        }
    }
    return result;
}

}  // namespace tetralight::detail
