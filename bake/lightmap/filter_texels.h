// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/lightmap/page_charts.h>

namespace tetralight {

struct TexelFilterSettings {
    int radius = 7;        ///< of the texels that a texel becomes a mean of, in texels
    int patch_radius = 2;  ///< of the patches that are compared
    int noise_radius = 3;  ///< of the texels that a texel shares its variance with
    /// Differences that count, in standard errors: larger blurs more.
    float strength = 0.45f;
    /// Largest angle between the normals of two texels.
    float max_angle_degrees = 20.0f;
};

/// What the filter compares of a texel.
struct NoisyTexel {
    /// Irradiance by both halves of the samples, which are independent.
    std::array<glm::vec3, 2> halves{};
    /// Variance of one half, sum over the colour channels, by its own samples.
    float variance = 0.0f;
    /// Number of its samples, or in proportion to it. Above 0.
    float sample_count = 1.0f;
    glm::vec3 normal{0.0f};
};

/// How much a texel takes of another. The weights of one half were found by comparing the other.
struct TexelShare {
    uint32_t texel = 0;
    std::array<float, 2> halves{};
};

/// Finds what each texel becomes a mean of, by dual-buffer non-local means (Rousselle, Knaus and
/// Zwicker 2012, "Adaptive Rendering with Non-Local Means Filtering"): texels around it in its
/// chart, and across seams, whose surroundings differ from its own by no more than noise explains.
///
/// The few estimates of a texel tell little about rare bright samples: where it missed them its
/// variance is too small. So the noise is that of the texels around it too (`pooled_variance`).
///
/// Weights are in proportion to the samples of texels, so that all samples count alike. Texels that
/// end at a target error because they missed what others found are then no darker than those.
///
/// The mean of a half has no bias by its own noise, as its weights depend on the other half. All
/// values of a texel are filtered by the same weights, so that what adds up before does so after
/// it. A function of the arguments alone.
///
/// Calls `use(texel, shares)` once for each texel of a chart, from any thread. The weights of a
/// half add up to 1; the texel itself is among the shares.
void filter_texels(const PageCharts& pages, std::span<const NoisyTexel> texels,
                   const TexelFilterSettings& settings, uint32_t thread_count,
                   const std::function<void(uint32_t, std::span<const TexelShare>)>& use);

}  // namespace tetralight
