// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/charts/detail/flat_triangle.h>

namespace tetralight::detail {

/// Samples of a rectangle that know if they lie in no triangle, in one or in more.
class CoverageGrid {
  public:
    static constexpr uint32_t kSamplesPerSide = 2048;

    /// Precondition: the rectangle has a positive, finite size.
    explicit CoverageGrid(const Box<glm::dvec2>& bounds);

    /// Adds a triangle of either orientation within the rectangle. Of two triangles with a common
    /// edge on different sides of it, a sample on that edge lies in one.
    void add(const FlatTriangle& triangle);

    /// Area of the part of the rectangle that lies in more than one triangle.
    [[nodiscard]] double overlap_area() const;

  private:
    static constexpr uint32_t kWordsPerRow = kSamplesPerSide / 64;

    /// First row of samples at or above y.
    [[nodiscard]] uint32_t row_from(double y) const;
    [[nodiscard]] uint32_t column_from(double x) const;
    void add_to_row(uint32_t row, uint32_t begin, uint32_t end);

    Box<glm::dvec2> bounds_;
    glm::dvec2 step_;              ///< distance of samples
    std::vector<uint64_t> once_;   ///< a bit for each sample in at least one triangle
    std::vector<uint64_t> twice_;  ///< a bit for each sample in at least two
};

}  // namespace tetralight::detail
