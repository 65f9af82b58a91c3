// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/check_lights.h>

#include <cmath>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

Status check_number(float value, const char* member, const char* name) {
    if (value >= 0.0f && std::isfinite(value)) return Ok{};
    return Error{ErrorCode::InvalidArgument, member, str_cat(value),
                 str_cat(name, " ", value, " is negative or not finite")};
}

Status check_light(const Light& light) {
    for (int channel = 0; channel < 3; ++channel) {
        const auto status = check_number(light.intensity[channel], ".intensity", "intensity");
        if (!status) return status;
    }
    const auto multiplier =
        check_number(light.indirect_multiplier, ".indirect_multiplier", "indirect multiplier");
    if (!multiplier) return multiplier;
    if (auto status = check_number(light.radius, ".radius", "radius"); !status) return status;
    return check_number(light.range, ".range", "range");
}

}  // namespace

Status check_lights(const Scene& scene) {
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const std::string name = i < scene.light_names.size() ? scene.light_names[i] : "";
        auto status = check_light(scene.lights[i]);
        if (status) status = check_characters(name);
        if (status) continue;
        const Error error = status.error().in(str_cat("light ", i, " \"", name, "\""));
        return detail::in_member(error, str_cat("lights[", i, "]"));
    }
    return Ok{};
}

}  // namespace tetralight
