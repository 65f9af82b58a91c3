// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <random>
#include <string>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>
#include <tetralight/reflection/reflections.h>

namespace tetralight::test {

inline RadianceTexel radiance_texel(const glm::vec3& radiance) {
    constexpr uint16_t kOne = 0x3c00;
    return {half_from_float(radiance.x), half_from_float(radiance.y), half_from_float(radiance.z),
            kOne};
}

inline glm::vec3 random_unit_vector(std::mt19937& random) {
    std::normal_distribution<float> value;
    return glm::normalize(glm::vec3(value(random), value(random), value(random)));
}

/// Columns are unit vectors at right angles.
inline glm::mat3 random_axes(std::mt19937& random) {
    const glm::vec3 x = random_unit_vector(random);
    const glm::vec3 y = glm::normalize(glm::cross(x, random_unit_vector(random)));
    return {x, y, glm::cross(x, y)};
}

/// A probe at the center of its box.
inline ReflectionProbe box_probe(const glm::dvec3& center, const glm::vec3& half_size,
                                 float blend_distance = 0.0f, int32_t importance = 1) {
    ReflectionProbe probe;
    probe.position = center;
    probe.half_size = half_size;
    probe.blend_distance = blend_distance;
    probe.importance = importance;
    return probe;
}

/// Cubes whose texels are `radiance(probe, level, direction)`.
template <class Radiance>
Reflections make_reflections(uint32_t size, uint32_t level_count,
                             const std::vector<ReflectionProbe>& probes, Radiance radiance) {
    Reflections reflections;
    reflections.size = size;
    reflections.probes = probes;
    reflections.levels.resize(level_count);
    for (uint32_t level = 0; level < level_count; ++level) {
        const uint32_t n = size >> level;
        for (uint32_t probe = 0; probe < probes.size(); ++probe) {
            for (uint32_t i = 0; i < kCubeFaceCount * n * n; ++i) {
                const CubeTexel texel{i / (n * n), i % n, i / n % n};
                reflections.levels[level].push_back(
                    radiance_texel(radiance(probe, level, cube_direction(texel, n))));
            }
        }
    }
    return reflections;
}

/// Random light in [0, 1].
inline Reflections make_random_reflections(uint32_t size, uint32_t level_count,
                                           const std::vector<ReflectionProbe>& probes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> value;
    return make_reflections(size, level_count, probes, [&](uint32_t, uint32_t, const glm::vec3&) {
        return glm::vec3(value(random), value(random), value(random));
    });
}

/// Two probes, a box and a sky, of 4 x 4 texels in two levels, with names and metadata.
inline Reflections make_small_reflections() {
    std::mt19937 random(2);
    const glm::mat3 axes = random_axes(random);
    ReflectionProbe box = box_probe({1.5, -2.25, 1e6}, {2.0f, 1.0f, 3.5f}, 0.5f, 7);
    box.box_center = {0.25f, 0.5f, -0.125f};
    box.axes = {axes[0], axes[1], axes[2]};
    box.validity = 0.75f;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        box.irradiance.coefficients[static_cast<size_t>(i)] = random_unit_vector(random);
    }
    Reflections reflections = make_random_reflections(4, 2, {box, ReflectionProbe{}});
    reflections.names = {"hall \"A\"", "sky\\dome é"};
    reflections.metadata = R"({"samples":16})";
    return reflections;
}

/// The same in two layers of random light, of weights 1 and 0.5.
inline Reflections make_layered_reflections() {
    Reflections reflections = make_small_reflections();
    reflections.layers.resize(2);
    reflections.layers[1].weight = 0.5f;
    reflections.layer_names = "sun\nlight:lamp\n";
    const size_t cubes = 2 * reflections.probes.size();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> value;
    for (const auto& level : reflections.levels) {
        auto& texels = reflections.layer_levels.emplace_back(2 * level.size());
        for (RadianceTexel& texel : texels)
            texel = radiance_texel({value(random), value(random), value(random)});
    }
    reflections.layer_irradiance.resize(cubes);
    for (IrradianceSh& irradiance : reflections.layer_irradiance) {
        for (glm::vec3& coefficient : irradiance.coefficients)
            coefficient = random_unit_vector(random);
    }
    return reflections;
}

}  // namespace tetralight::test
