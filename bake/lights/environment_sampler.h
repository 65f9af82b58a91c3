// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// Samples directions in proportion to how much brighter than average the environment image is.
///
/// The weight of a texel is the integral of the bilinear lookup over it minus the mean of the sky,
/// but at least a sixteenth of the integral. BSDF sampling finds the light that is subtracted, so
/// that the two have to be combined by multiple importance sampling (Karlík et al. 2019, "MIS
/// Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling"). The density is
/// positive wherever the lookup is.
class EnvironmentSampler {
  public:
    /// Keeps no reference; takes 4 bytes per texel.
    explicit EnvironmentSampler(const Environment& environment);

    /// True if there is no image, or it is black.
    [[nodiscard]] bool is_empty() const { return row_ends_.empty(); }

    /// A unit direction for `u` uniform in [0, 1)². Precondition: not empty.
    [[nodiscard]] glm::vec3 sample(glm::vec2 u) const noexcept;

    /// Density of a direction, per steradian; 0 when empty.
    [[nodiscard]] float pdf(glm::vec3 direction) const noexcept;

  private:
    [[nodiscard]] float texel_pdf(uint32_t column, uint32_t row) const noexcept;

    uint32_t width_ = 0, height_ = 0;
    float rotation_radians_ = 0.0f;
    std::vector<float> row_ends_;     // cumulative distribution over the rows; ends with 1
    std::vector<float> column_ends_;  // the same over the columns of each row
};

}  // namespace tetralight
