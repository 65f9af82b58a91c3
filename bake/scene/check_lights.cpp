// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/check_lights.h>

#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

Status check(float value, const char* name) {
    if (value >= 0.0f && std::isfinite(value)) return Ok{};
    return Error{str_cat(name, " ", value, " is negative or not finite")};
}

Status check_light(const Light& light) {
    for (int channel = 0; channel < 3; ++channel) {
        if (auto status = check(light.intensity[channel], "intensity"); !status) return status;
    }
    if (auto status = check(light.indirect_multiplier, "indirect multiplier"); !status) {
        return status;
    }
    if (auto status = check(light.radius, "radius"); !status) return status;
    return check(light.range, "range");
}

}  // namespace

Status check_lights(const Scene& scene) {
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const std::string name = i < scene.light_names.size() ? scene.light_names[i] : "";
        auto status = check_light(scene.lights[i]);
        if (status) status = check_characters(name);
        if (status) continue;
        return status.error().in(str_cat("light ", i, " \"", name, "\""));
    }
    return Ok{};
}

}  // namespace tetralight
