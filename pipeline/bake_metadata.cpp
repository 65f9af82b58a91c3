// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_metadata.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>

namespace tetralight {
namespace {

using Json = nlohmann::ordered_json;

/// The shortest decimal number that reads back to the same float or double; no ".0" at the end.
template <class Float>
Json shortest(Float value) {
    constexpr auto kLargestExact = static_cast<Float>(1u << 24);
    if (std::trunc(value) == value && std::abs(value) <= kLargestExact) {
        return static_cast<int64_t>(value);
    }
    const std::string digits = str_cat(value);
    double number = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

void add_bake(const BakeSettings& bake, Json& json) {
    if (bake.target_error != 0.0) json["target_error"] = shortest(bake.target_error);
    if (bake.max_sample_count != 0) json["max_samples"] = bake.max_sample_count;
    if (bake.time_budget_seconds != 0.0) {
        json["time_budget_seconds"] = shortest(bake.time_budget_seconds);
    }
    if (bake.clamp != 0.0f) json["clamp"] = shortest(bake.clamp);
    const auto& [albedo_boost, max_albedo] = bake.surfaces;
    if (bake.surfaces == SurfaceSettings{}) return;
    if (albedo_boost != 0.0f) json["albedo_boost"] = shortest(albedo_boost);
    if (max_albedo != 0.0f) json["max_albedo"] = shortest(max_albedo);
}

}  // namespace

std::string bake_metadata(const Scene& scene, const BakeVolumeSettings& settings,
                          bool has_overrides, bool has_dering) {
    const HealthSettings& health = settings.health;
    const MixedLighting mixed = settings.lighting.mixed_lighting;
    Json json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
    json["samples"] = settings.bake.sample_count;
    json["bounces"] = settings.bake.bounces;
    json["seed"] = settings.bake.seed;
    json["min_validity"] = shortest(health.min_validity);
    json["virtual_offset"] = shortest(health.virtual_offset);
    json["invalid_probes"] = name_of(health.invalid);
    add_bake(settings.bake, json);
    if (mixed != MixedLighting::Indirect) json["mixed_lighting"] = name_of(mixed);
    if (has_overrides) json["adjustments"] = hex(adjustments_key(scene.probe_adjustments));
    if (has_dering) json["dering"] = name_of(settings.dering.window);
    return json.dump();
}

}  // namespace tetralight
