// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/space_light.h>

#include <algorithm>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/bake_settings.h>

namespace tetralight {
namespace {

constexpr uint32_t kSampleCount = 128;
constexpr uint32_t kSky = 0, kLights = 1, kLayerCount = 2;
/// Light counts if it reaches more than this fraction of the positions.
constexpr double kLeastShare = 0.03;

/// All lights as baked ones in one layer, the sky in another.
LightPlan plan_for(const Scene& scene) {
    LightPlan plan;
    plan.light_modes.assign(scene.lights.size(), LightMode::Baked);
    plan.layer_count = kLayerCount;
    plan.layer_of_sky = kSky;
    plan.layer_of_light.assign(scene.lights.size(), kLights);
    plan.layer_of_material.assign(scene.materials.size(), kLights);
    return plan;
}

bool is_any(std::span<const double> values) {
    return std::ranges::any_of(values, [](double value) { return value != 0.0; });
}

}  // namespace

Result<std::vector<SpaceLight>> find_space_light(const Scene& scene,
                                                 std::span<const std::vector<glm::dvec3>> parts,
                                                 uint32_t thread_count) {
    BakeSettings settings;
    settings.sample_count = kSampleCount;
    settings.thread_count = thread_count;
    settings.plan = plan_for(scene);
    std::vector<glm::dvec3> positions;
    for (const auto& part : parts) positions.insert(positions.end(), part.begin(), part.end());
    const LightGroupLayout layout(settings.plan);
    std::vector<ProbeAccumulator> accumulators(positions.size());
    std::vector<double> rows(positions.size() * layout.size(), 0.0);
    auto status = bake_accumulators(scene, {positions}, settings, accumulators, {}, {rows, {}});
    if (!status) return status.error();

    std::vector<SpaceLight> light;
    size_t position = 0;
    for (const auto& part : parts) {
        size_t with_sky = 0, with_lights = 0;
        for (size_t i = 0; i < part.size(); ++i, ++position) {
            const auto row = std::span(rows).subspan(position * layout.size(), layout.size());
            constexpr size_t kSize = LightGroupLayout::kLayerSize;
            with_sky += is_any(row.subspan(kSky * kSize, kSize));
            with_lights += is_any(row.subspan(kLights * kSize, kSize));
        }
        const double least = kLeastShare * static_cast<double>(part.size());
        light.push_back(
            {static_cast<double>(with_sky) > least, static_cast<double>(with_lights) > least});
    }
    return light;
}

}  // namespace tetralight
