// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_light_extras.h>

#include <cmath>
#include <numbers>
#include <utility>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Returns invalid_argument for the member `extras.NAME`; messages begin with its name.
Error extra_error(const char* name, std::string value, const std::string& message) {
    return {ErrorCode::InvalidArgument, str_cat(".extras.", name), std::move(value),
            str_cat("extras.", name, message)};
}

/// Returns invalid_argument for a word that is not one of those allowed.
Error word_error(const char* name, const std::string& word, const char* allowed) {
    return extra_error(name, word, str_cat(" \"", word, "\" is ", allowed));
}

Result<LightMode> mode_from(const std::string& mode) {
    if (mode == "mixed") return LightMode::Mixed;
    if (mode == "baked") return LightMode::Baked;
    if (mode == "realtime") return LightMode::Realtime;
    return word_error("mode", mode, "not \"mixed\", \"baked\" or \"realtime\"");
}

Result<LightFalloff> falloff_from(const std::string& falloff) {
    if (falloff == "gltf") return LightFalloff::Gltf;
    if (falloff == "inverse-square-range") return LightFalloff::InverseSquareRange;
    if (falloff == "linear") return LightFalloff::Linear;
    if (falloff == "legacy") return LightFalloff::Legacy;
    return word_error("falloff", falloff,
                      "not \"gltf\", \"inverse-square-range\", \"linear\" or \"legacy\"");
}

/// A number ≥ 0, or `otherwise` if there is none.
Result<float> number_from(const std::optional<double>& value, const char* name, float otherwise) {
    if (!value) return otherwise;
    const auto number = static_cast<float>(*value);
    if (std::isnan(*value)) return extra_error(name, "", " is not a number");
    if (number >= 0.0f && std::isfinite(number)) return number;
    return extra_error(name, str_cat(*value), str_cat(" ", *value, " is negative or too large"));
}

Status apply_mode(const GltfLightExtras& extras, Light& light) {
    const auto mode = mode_from(extras.mode.value_or("mixed"));
    if (!mode) return mode.error();
    const auto multiplier = number_from(extras.indirect_multiplier, "indirect_multiplier", 1.0f);
    if (!multiplier) return multiplier.error();
    light.mode = *mode;
    light.indirect_multiplier = *multiplier;
    return Ok{};
}

Status apply_falloff(const GltfLightExtras& extras, Light& light) {
    if (!extras.falloff) return Ok{};
    const auto falloff = falloff_from(*extras.falloff);
    if (!falloff) return falloff.error();
    light.falloff = *falloff;
    const bool is_distant = light.type == LightType::Directional;
    if (is_distant) {
        return extra_error("falloff", *extras.falloff, " is not for directional lights");
    }
    if (light.falloff == LightFalloff::Gltf || light.range > 0.0f) return Ok{};
    return extra_error("falloff", *extras.falloff,
                       str_cat(" \"", *extras.falloff, "\" needs a range > 0"));
}

Status apply_size(const GltfLightExtras& extras, Light& light) {
    const bool is_distant = light.type == LightType::Directional;
    if (is_distant && extras.radius) {
        return extra_error("radius", str_cat(*extras.radius),
                           " is not for directional lights; they have extras.angle");
    }
    if (!is_distant && extras.angle_degrees) {
        return extra_error("angle", str_cat(*extras.angle_degrees),
                           " is for directional lights; others have extras.radius");
    }
    const auto radius = number_from(extras.radius, "radius", 0.0f);
    if (!radius) return radius.error();
    const auto angle = number_from(extras.angle_degrees, "angle", 0.0f);
    if (!angle) return angle.error();
    if (*angle > 180.0f) {
        return extra_error("angle", str_cat(*angle),
                           str_cat(" ", *angle, " is more than 180 degrees"));
    }
    light.radius = is_distant ? *angle / 360.0f * std::numbers::pi_v<float> : *radius;
    return Ok{};
}

Status apply_rectangle(const GltfLightExtras& extras, Light& light) {
    const auto width = number_from(extras.width, "width", 0.0f);
    if (!width) return width.error();
    const auto height = number_from(extras.height, "height", 0.0f);
    if (!height) return height.error();
    if (*width == 0.0f || *height == 0.0f) {
        return extra_error("shape", "rectangle", " \"rectangle\" needs a width and a height > 0");
    }
    light.type = LightType::Rectangle;
    light.radius = 0.0f;
    light.width = *width;
    light.height = *height;
    return Ok{};
}

Status apply_shape(const GltfLightExtras& extras, Light& light) {
    if (!extras.shape) return Ok{};
    if (light.type == LightType::Directional) {
        return extra_error("shape", *extras.shape, " is not for directional lights");
    }
    if (*extras.shape == "rectangle") return apply_rectangle(extras, light);
    if (*extras.shape != "disc") {
        return word_error("shape", *extras.shape, "neither \"rectangle\" nor \"disc\"");
    }
    if (light.radius == 0.0f) {
        return extra_error("shape", "disc", " \"disc\" needs a radius > 0");
    }
    light.type = LightType::Disc;
    return Ok{};
}

}  // namespace

GltfLightExtras merged_extras(const GltfLightExtras& of_node, const GltfLightExtras& of_light) {
    const auto either = [](const auto& first, const auto& second) {
        return first ? first : second;
    };
    GltfLightExtras result;
    result.mode = either(of_node.mode, of_light.mode);
    result.falloff = either(of_node.falloff, of_light.falloff);
    result.shape = either(of_node.shape, of_light.shape);
    result.indirect_multiplier = either(of_node.indirect_multiplier, of_light.indirect_multiplier);
    result.radius = either(of_node.radius, of_light.radius);
    result.angle_degrees = either(of_node.angle_degrees, of_light.angle_degrees);
    result.width = either(of_node.width, of_light.width);
    result.height = either(of_node.height, of_light.height);
    return result;
}

Status apply_light_extras(const GltfLightExtras& extras, Light& light) {
    if (const auto status = apply_mode(extras, light); !status) return status;
    if (const auto status = apply_falloff(extras, light); !status) return status;
    if (const auto status = apply_size(extras, light); !status) return status;
    return apply_shape(extras, light);
}

Status apply_area_light_extras(const GltfLightExtras& extras, Light& light) {
    const std::pair<const char*, bool> others[] = {
        {"falloff", extras.falloff.has_value()}, {"shape", extras.shape.has_value()},
        {"radius", extras.radius.has_value()},   {"angle", extras.angle_degrees.has_value()},
        {"width", extras.width.has_value()},     {"height", extras.height.has_value()}};
    for (const auto& [name, is_there] : others) {
        if (!is_there) continue;
        return extra_error(name, "",
                           " is not for lights of EXT_lights_area, which say it themselves");
    }
    return apply_mode(extras, light);
}

}  // namespace tetralight::detail
