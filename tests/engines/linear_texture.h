// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace tetralight::test {

/// What a GPU reads of a 3D texture with linear filtering and clamped addresses. `texel(index)` is
/// that of a place, where x varies fastest, then y, then z.
template <class Texel>
[[nodiscard]] auto filtered_texel(const glm::uvec3& size, const glm::vec3& uvw, Texel&& texel) {
    const glm::vec3 place = uvw * glm::vec3(size) - 0.5f;
    const glm::vec3 low = glm::floor(place);
    const glm::vec3 share = place - low;
    decltype(1.0f * texel(size_t{0})) sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 weights = glm::mix(1.0f - share, share, glm::vec3(step));
        const glm::uvec3 p(glm::clamp(glm::ivec3(low) + step, glm::ivec3(0), glm::ivec3(size) - 1));
        const size_t index = (size_t{p.z} * size.y + p.y) * size.x + p.x;
        sum += weights.x * weights.y * weights.z * texel(index);
    }
    return sum;
}

}  // namespace tetralight::test
