// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/stitch_light.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// The values of a `TexelLight` one by one: irradiance, flux, vector.
constexpr size_t kValueCount = 15;
/// Of these the first ones are not negative: irradiance and flux.
constexpr size_t kPositiveCount = 6;

float& value_of(TexelLight& light, size_t i) {
    if (i < 3) return light.irradiance[static_cast<int>(i)];
    if (i < 6) return light.flux[static_cast<int>(i) - 3];
    const auto k = static_cast<int>(i) - 6;
    return light.vector[k / 3][k % 3];
}

/// Of the total, for all channels and layers.
void hold_zeros(SeamStitcher& stitcher, std::span<const TexelLight> total) {
    std::vector<double> brightness;
    for (const TexelLight& light : total)
        brightness.push_back(double{light.irradiance.x + light.irradiance.y + light.irradiance.z});
    stitcher.hold_zeros(brightness);
}

void stitch_values(const SeamStitcher& stitcher, std::vector<TexelLight>& lights,
                   uint32_t thread_count) {
    parallel_for(kValueCount, thread_count, [&](size_t value) {
        std::vector<double> values;
        for (TexelLight& light : lights) values.push_back(double{value_of(light, value)});
        const bool is_positive = value < kPositiveCount;
        const std::vector<double> stitched = stitcher.stitched(values);
        for (size_t i = 0; i < stitched.size(); ++i) {
            const auto number = static_cast<float>(stitched[i]);
            value_of(lights[i], value) = is_positive ? std::max(0.0f, number) : number;
        }
    });
}

/// Layers that would have become negative are 0, which leaves the others with more than the total:
/// they get their parts of it.
void add_up(const std::vector<TexelLight>& total, std::vector<std::vector<TexelLight>>& layers) {
    for (size_t i = 0; i < total.size(); ++i) {
        TexelLight whole = total[i];
        for (size_t value = 0; value < kPositiveCount; ++value) {
            float sum = 0.0f;
            for (auto& layer : layers) sum += value_of(layer[i], value);
            const float factor = sum > 0.0f ? value_of(whole, value) / sum : 0.0f;
            for (auto& layer : layers) value_of(layer[i], value) *= factor;
        }
    }
}

void set_vectors_by_irradiance(std::vector<TexelLight>& lights,
                               std::span<const glm::vec3> normals) {
    for (size_t i = 0; i < lights.size(); ++i) {
        TexelLight& light = lights[i];
        const float square = glm::dot(normals[i], normals[i]);
        if (!(square > 0.0f)) continue;
        for (int channel = 0; channel < 3; ++channel) {
            glm::vec3& vector = light.vector[channel];
            const float missing = light.irradiance[channel] - glm::dot(normals[i], vector);
            vector += normals[i] * (missing / square);
        }
    }
}

}  // namespace

void stitch_light(SeamStitcher& stitcher, std::span<const glm::vec3> normals,
                  std::vector<TexelLight>& total, std::vector<std::vector<TexelLight>>& layers,
                  uint32_t thread_count) {
    TETRALIGHT_ASSERT(normals.size() == total.size(), "one for each texel");
    hold_zeros(stitcher, total);
    stitch_values(stitcher, total, thread_count);
    for (std::vector<TexelLight>& layer : layers) stitch_values(stitcher, layer, thread_count);
    add_up(total, layers);
    set_vectors_by_irradiance(total, normals);
    for (std::vector<TexelLight>& layer : layers) set_vectors_by_irradiance(layer, normals);
}

}  // namespace tetralight
