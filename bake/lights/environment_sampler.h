// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// Draws directions in which an environment image shines more than elsewhere.
///
/// A texel's weight is the integral of the bilinear lookup over it, less the mean of the sky but
/// never less than a sixteenth of it: what is left is found well enough by chance, which who
/// samples both ways must weigh in (Karlík et al. 2019, "MIS Compensation"). Density is positive
/// wherever the lookup is.
class EnvironmentSampler {
  public:
    /// Copies what it needs: 4 bytes a texel.
    explicit EnvironmentSampler(const Environment& environment);

    /// Whether there is nothing to draw: no image, or one of no light.
    [[nodiscard]] bool is_empty() const { return row_ends_.empty(); }

    /// A unit direction for `u` uniform in [0, 1)². Precondition: not empty.
    [[nodiscard]] glm::vec3 sample(glm::vec2 u) const noexcept;

    /// Density of a direction, per steradian; 0 when empty.
    [[nodiscard]] float pdf(glm::vec3 direction) const noexcept;

  private:
    [[nodiscard]] float texel_pdf(uint32_t column, uint32_t row) const noexcept;

    uint32_t width_ = 0, height_ = 0;
    float rotation_radians_ = 0.0f;
    std::vector<float> row_ends_;     // cumulated shares of the rows, 1 at the end
    std::vector<float> column_ends_;  // of the columns in each row
};

}  // namespace tetralight
