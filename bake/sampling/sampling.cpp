// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/sampling.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/mix.h>

namespace tetralight {

using detail::kGoldenRatio64;
using detail::mix;

namespace {}  // namespace

// Without branches (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
glm::mat3 frame_around(glm::vec3 n) noexcept {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

uint64_t probe_key(uint64_t seed, const glm::dvec3& position) noexcept {
    uint64_t key = mix(seed + kGoldenRatio64);
    for (int axis = 0; axis < 3; ++axis) {
        const double canonical = position[axis] + 0.0;  // maps -0 to 0
        key = mix(key ^ std::bit_cast<uint64_t>(canonical)) + kGoldenRatio64;
    }
    return key;
}

RandomStream::RandomStream(uint64_t key, uint64_t stream) noexcept
    : state_(mix(key ^ mix(stream + kGoldenRatio64))) {}

float RandomStream::next() noexcept {
    state_ += kGoldenRatio64;
    return static_cast<float>(mix(state_) >> 40) * 0x1p-24f;
}

glm::vec2 RandomStream::next2() noexcept {
    const float x = next();
    return {x, next()};
}

glm::vec3 spherical_fibonacci(uint32_t i, uint32_t count) noexcept {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double turn = i * (std::numbers::phi - 1.0);
    const double angle = 2.0 * std::numbers::pi * (turn - std::floor(turn));
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

std::vector<glm::vec3> spherical_fibonacci(uint32_t count) {
    std::vector<glm::vec3> directions;
    directions.reserve(count);
    for (uint32_t i = 0; i < count; ++i) directions.push_back(spherical_fibonacci(i, count));
    return directions;
}

glm::mat3 sample_rotation(RandomStream& random) noexcept {
    const float u = random.next();
    const float a = 2.0f * std::numbers::pi_v<float> * random.next();
    const float b = 2.0f * std::numbers::pi_v<float> * random.next();
    const float r = std::sqrt(1.0f - u);
    const float s = std::sqrt(u);
    const float x = r * std::sin(a), y = r * std::cos(a);
    const float z = s * std::sin(b), w = s * std::cos(b);
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

glm::vec3 sample_cosine_hemisphere(glm::vec3 normal, glm::vec2 u) noexcept {
    const float angle = 2.0f * std::numbers::pi_v<float> * u.x;
    const float radius = std::sqrt(u.y);
    const glm::vec3 local(radius * std::cos(angle), radius * std::sin(angle),
                          std::sqrt(1.0f - u.y));
    return glm::normalize(frame_around(normal) * local);
}

float sample_cosine_hemisphere_pdf(glm::vec3 normal, glm::vec3 direction) noexcept {
    return std::max(0.0f, glm::dot(normal, direction)) * std::numbers::inv_pi_v<float>;
}

glm::vec3 sample_cone(glm::vec3 axis, float min_cosine, glm::vec2 u) noexcept {
    const float angle = 2.0f * std::numbers::pi_v<float> * u.x;
    const float drop = u.y * (1.0f - min_cosine);  // 1 − cos θ, which is precise near the axis
    const float radius = std::sqrt(drop * (2.0f - drop));
    const glm::vec3 local(radius * std::cos(angle), radius * std::sin(angle), 1.0f - drop);
    return glm::normalize(frame_around(axis) * local);
}

float sample_cone_pdf(float min_cosine) noexcept {
    return 0.5f * std::numbers::inv_pi_v<float> / (1.0f - min_cosine);
}

glm::vec3 sample_disc_around(glm::vec3 normal, glm::vec2 u) noexcept {
    const float angle = 2.0f * std::numbers::pi_v<float> * u.x;
    const float radius = std::sqrt(u.y);
    return frame_around(normal) * glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
}

}  // namespace tetralight
