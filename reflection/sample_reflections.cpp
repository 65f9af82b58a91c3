// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/sample_reflections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>
#include <tetralight/reflection/detail/probe_box.h>

namespace tetralight {
namespace {

/// The texels of one cube at one level; none if the level lacks them.
struct CubeLevel {
    std::span<const RadianceTexel> texels;
    uint32_t size = 0;
};

CubeLevel level_of(const ReflectionsView& reflections, uint32_t probe, uint32_t level) noexcept {
    if (reflections.size > kLargestCubeSize || level >= kMaxReflectionLevels) return {};
    const uint64_t size = reflections.size >> level;
    const uint64_t count = kCubeFaceCount * size * size;
    const std::span<const RadianceTexel> all = reflections.levels[level];
    if (count == 0 || (uint64_t{probe} + 1) * count > all.size()) return {};
    const auto texels_per_cube = static_cast<size_t>(count);
    return {all.subspan(probe * texels_per_cube, texels_per_cube), static_cast<uint32_t>(size)};
}

glm::vec3 radiance_of(const RadianceTexel& texel) noexcept {
    return {float_from_half(texel[0]), float_from_half(texel[1]), float_from_half(texel[2])};
}

glm::vec3 texel_radiance(const CubeLevel& level, const CubeTexel& texel) noexcept {
    return radiance_of(
        level.texels[(size_t{texel.face} * level.size + texel.y) * level.size + texel.x]);
}

/// Along one axis: the first of two texels, which may be -1, and the weight of the second.
struct CubeStep {
    int first = 0;
    float weight = 0.0f;
};

CubeStep cube_step(float coordinate, uint32_t size) noexcept {
    const float place = coordinate * static_cast<float>(size) - 0.5f;
    const float first = std::floor(place);
    return {static_cast<int>(first), place - first};
}

/// Bilinear. Where three faces share a corner, their texels beside it stand for the fourth, as
/// OpenGL recommends (4.6 specification, section 8.14.2).
glm::vec3 sample_level(const CubeLevel& level, const CubePlace& place) noexcept {
    if (level.texels.empty()) return glm::vec3(0.0f);
    const CubeStep u = cube_step(place.uv.x, level.size), v = cube_step(place.uv.y, level.size);
    const int last = static_cast<int>(level.size) - 1;
    std::array<glm::vec3, 4> corners;
    int missing = -1;
    for (int i = 0; i < 4; ++i) {
        const int x = u.first + (i & 1), y = v.first + (i >> 1);
        const bool is_beyond_x = x < 0 || x > last, is_beyond_y = y < 0 || y > last;
        if (is_beyond_x && is_beyond_y) {
            missing = i;
        } else if (is_beyond_x || is_beyond_y) {
            corners[i] = texel_radiance(level, wrapped_texel(place.face, x, y, level.size));
        } else {
            corners[i] = texel_radiance(
                level, {place.face, static_cast<uint32_t>(x), static_cast<uint32_t>(y)});
        }
    }
    if (missing >= 0) {
        corners[missing] =
            (corners[missing ^ 1] + corners[missing ^ 2] + corners[missing ^ 3]) / 3.0f;
    }
    return glm::mix(glm::mix(corners[0], corners[1], u.weight),
                    glm::mix(corners[2], corners[3], u.weight), v.weight);
}

float luminance(const glm::vec3& color) noexcept {
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Distance along a direction from a place inside a box to its side.
double distance_to_side(const glm::dvec3& half_size, const glm::dvec3& place,
                        const glm::dvec3& direction) noexcept {
    double distance = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0.0) continue;
        const double side = direction[i] > 0.0 ? half_size[i] : -half_size[i];
        distance = std::min(distance, (side - place[i]) / direction[i]);
    }
    return distance;
}

/// The sum of `light(probe)` by the weights of a blend.
template <class Light>
glm::vec3 blended(const ReflectionsView& reflections, const ReflectionBlend& blend,
                  const Light& light) noexcept {
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < ReflectionBlend::kMaxProbes; ++i) {
        const uint32_t probe = blend.probes[i];
        if (!(blend.weights[i] > 0.0f) || probe >= reflections.probes.size()) continue;
        sum += blend.weights[i] * light(probe);
    }
    return sum;
}

}  // namespace

glm::vec3 project_on_box(const ReflectionProbe& probe, const glm::dvec3& position,
                         glm::vec3 direction) noexcept {
    const glm::dvec3 along = glm::normalize(glm::dvec3(direction));
    const double influence = probe.is_everywhere() ? 0.0 : reflection_influence(probe, position);
    if (!(influence > 0.0)) return glm::vec3(along);
    const glm::dvec3 half_size(probe.half_size);
    const glm::dvec3 place =
        glm::clamp(detail::place_in_box(probe, position), -half_size, half_size);
    const glm::dvec3 direction_in_box = detail::box_from_world(probe, along);
    const glm::dvec3 hit =
        place + distance_to_side(half_size, place, direction_in_box) * direction_in_box;
    const glm::dvec3 from_probe = glm::dvec3(probe.box_center) + detail::world_from_box(probe, hit);
    const double length = glm::length(from_probe);
    if (!(length > 0.0 && std::isfinite(length))) return glm::vec3(along);
    const glm::dvec3 mixed = glm::mix(along, from_probe / length, influence);
    return glm::vec3(influence == 1.0 ? mixed : glm::normalize(mixed));
}

glm::vec3 sample_cube(const ReflectionsView& reflections, uint32_t probe, glm::vec3 direction,
                      float roughness) noexcept {
    const uint32_t count = std::min(reflections.level_count, kMaxReflectionLevels);
    const float level = level_of_roughness(roughness, count);
    const auto lower = static_cast<uint32_t>(level);
    const float weight = level - static_cast<float>(lower);
    const CubePlace place = cube_place(direction);
    const glm::vec3 radiance = sample_level(level_of(reflections, probe, lower), place);
    if (weight == 0.0f) return radiance;
    return glm::mix(radiance, sample_level(level_of(reflections, probe, lower + 1), place), weight);
}

glm::vec3 sample_reflections(const ReflectionsView& reflections, const ReflectionBlend& blend,
                             const glm::dvec3& position, glm::vec3 direction,
                             float roughness) noexcept {
    return blended(reflections, blend, [&](uint32_t probe) {
        const glm::vec3 along = project_on_box(reflections.probes[probe], position, direction);
        return sample_cube(reflections, probe, along, roughness);
    });
}

glm::vec3 sample_far_reflections(const ReflectionsView& reflections, const ReflectionBlend& blend,
                                 glm::vec3 direction, float roughness) noexcept {
    return blended(reflections, blend, [&](uint32_t probe) {
        return sample_cube(reflections, probe, direction, roughness);
    });
}

glm::vec3 reflection_irradiance(const ReflectionsView& reflections, const ReflectionBlend& blend,
                                glm::vec3 normal) noexcept {
    return blended(reflections, blend, [&](uint32_t probe) {
        return evaluate_irradiance(reflections.probes[probe].irradiance, normal);
    });
}

float reflection_occlusion(glm::vec3 irradiance, glm::vec3 probe_irradiance,
                           float roughness) noexcept {
    constexpr float kMirror = 0.1f, kRough = 0.5f;
    const float here = luminance(irradiance), there = luminance(probe_irradiance);
    if (!(there > 0.0f)) return 1.0f;
    const float ratio = here > 0.0f ? std::min(here / there, 1.0f) : 0.0f;
    return glm::mix(1.0f, ratio, glm::smoothstep(kMirror, kRough, roughness));
}

}  // namespace tetralight
