// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/occlusion_channels.h>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include <tetralight/bake/lights/light_bounds.h>
#include <tetralight/bake/lights/light_volume.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

constexpr uint32_t kChannelCount = 4;

/// The lights that need a channel, in the order of assignment. The order depends on their
/// properties first, and on their index in the scene only for equal lights.
std::vector<uint32_t> order_of(std::span<const Light> lights, std::span<const std::string> names,
                               MixedLighting mode) {
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const bool needs_channel = baked_terms(lights[i].mode, mode).has_occlusion;
        if (needs_channel && can_have_occlusion(lights[i].type)) order.push_back(i);
    }
    const auto key = [&](uint32_t i) {
        const Light& light = lights[i];
        const glm::vec3& p = light.position;
        return std::tuple(light.type != LightType::Directional, -power_of(light.intensity),
                          std::string_view(names[i]), p.x, p.y, p.z, i);
    };
    std::ranges::sort(order, {}, key);
    return order;
}

}  // namespace

OcclusionChannels assign_channels(std::span<const Light> lights, std::span<const std::string> names,
                                  MixedLighting mode) {
    TETRALIGHT_ASSERT(names.size() == lights.size(), "one name for each light");
    OcclusionChannels result{std::vector<uint32_t>(lights.size(), kNoIndex),
                             std::vector<bool>(lights.size(), false)};
    std::vector<uint32_t> chosen;
    for (const uint32_t light : order_of(lights, names, mode)) {
        std::array<bool, kChannelCount> is_taken{};
        for (const uint32_t other : chosen) {
            if (may_overlap(lights[light], lights[other])) is_taken[result.of_light[other]] = true;
        }
        const auto free = std::ranges::find(is_taken, false);
        if (free == is_taken.end()) {
            result.fell_back[light] = true;
            continue;
        }
        result.of_light[light] = static_cast<uint32_t>(free - is_taken.begin());
        chosen.push_back(light);
    }
    return result;
}

OcclusionLights occlusion_lights_at(const glm::dvec3& position, std::span<const Light> lights,
                                    std::span<const uint32_t> channels) {
    OcclusionLights channel_lights{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    std::array<float, kChannelCount> nearest;
    nearest.fill(std::numeric_limits<float>::infinity());
    for (uint32_t light = 0; light < lights.size(); ++light) {
        const uint32_t channel = channels[light];
        if (channel == kNoIndex) continue;
        const float distance = distance_to_volume(lights[light], position);
        if (channel_lights[channel] != kNoIndex && distance >= nearest[channel]) continue;
        channel_lights[channel] = light;
        nearest[channel] = distance;
    }
    return channel_lights;
}

}  // namespace tetralight
