// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/reflections.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetralight {

ReflectionsView Reflections::view() const noexcept {
    ReflectionsView view;
    view.size = size;
    view.level_count = static_cast<uint32_t>(levels.size());
    view.probes = probes;
    const size_t count = std::min<size_t>(levels.size(), kMaxReflectionLevels);
    for (size_t level = 0; level < count; ++level) view.levels[level] = levels[level];
    view.layers = layers;
    view.layer_names = layer_names;
    view.layer_irradiance = layer_irradiance;
    const size_t layer_count = std::min<size_t>(layer_levels.size(), kMaxReflectionLevels);
    for (size_t level = 0; level < layer_count; ++level)
        view.layer_levels[level] = layer_levels[level];
    view.metadata = metadata;
    return view;
}

float roughness_of_level(uint32_t level, uint32_t level_count) noexcept {
    if (level_count < 2) return 0.0f;
    const float share = static_cast<float>(level) / static_cast<float>(level_count - 1);
    return 1.0f - std::sqrt(1.0f - share);
}

float level_of_roughness(float roughness, uint32_t level_count) noexcept {
    if (level_count < 2 || !(roughness > 0.0f)) return 0.0f;
    const float most_one = std::min(roughness, 1.0f);
    return most_one * (2.0f - most_one) * static_cast<float>(level_count - 1);
}

uint32_t reflection_level_count(uint32_t size) noexcept {
    constexpr int kWidthOf8 = 4;
    return static_cast<uint32_t>(
        std::max(static_cast<int>(std::bit_width(size)) - kWidthOf8 + 1, 1));
}

}  // namespace tetralight
