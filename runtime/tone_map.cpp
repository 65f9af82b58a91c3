// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/tone_map.h>

#include <algorithm>
#include <glm/common.hpp>

namespace tetralight {

glm::vec3 tone_map_neutral(glm::vec3 color) noexcept {
    constexpr float kFresnel = 0.04f;
    constexpr float kStart = 0.8f - kFresnel;
    constexpr float kDesaturation = 0.15f;

    const float darkest = std::min({color.x, color.y, color.z});
    const float toe =
        darkest < 2 * kFresnel ? darkest - darkest * darkest / (4 * kFresnel) : kFresnel;
    color -= toe;
    const float peak = std::max({color.x, color.y, color.z});
    if (peak < kStart) return color;

    constexpr float kRoom = 1.0f - kStart;
    const float compressed = 1.0f - kRoom * kRoom / (peak + kRoom - kStart);
    const float white = 1.0f - 1.0f / (kDesaturation * (peak - compressed) + 1.0f);
    return glm::mix(color * (compressed / peak), glm::vec3(compressed), white);
}

}  // namespace tetralight
