// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/coverage_grid.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace tetralight::detail {

namespace {

/// First of the samples at `least + step * (i + 0.5)` that is at or past a coordinate.
uint32_t sample_from(double coordinate, double least, double step) {
    const double i = std::ceil((coordinate - least) / step - 0.5);
    return static_cast<uint32_t>(std::clamp(i, 0.0, double{CoverageGrid::kSamplesPerSide}));
}

/// Where a line through two points has the given y. Does not depend on their order.
double crossing(glm::dvec2 a, glm::dvec2 b, double y) {
    if (a.y > b.y) std::swap(a, b);
    return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

}  // namespace

CoverageGrid::CoverageGrid(const Box<glm::dvec2>& bounds)
    : bounds_(bounds),
      step_(bounds.size() / double{kSamplesPerSide}),
      once_(size_t{kWordsPerRow} * kSamplesPerSide),
      twice_(size_t{kWordsPerRow} * kSamplesPerSide) {}

uint32_t CoverageGrid::row_from(double y) const {
    return sample_from(y, bounds_.min.y, step_.y);
}

uint32_t CoverageGrid::column_from(double x) const {
    return sample_from(x, bounds_.min.x, step_.x);
}

void CoverageGrid::add(const FlatTriangle& triangle) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    const uint32_t end = row_from(high);
    for (uint32_t row = row_from(low); row < end; ++row) {
        const double y = bounds_.min.y + step_.y * (row + 0.5);
        double left = std::numeric_limits<double>::infinity();
        double right = -left;
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec2 a = triangle[k], b = triangle[(k + 1) % 3];
            if ((a.y <= y) == (b.y <= y)) continue;
            const double x = crossing(a, b, y);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        if (left < right) add_to_row(row, column_from(left), column_from(right));
    }
}

void CoverageGrid::add_to_row(uint32_t row, uint32_t begin, uint32_t end) {
    for (uint32_t x = begin; x < end;) {
        const uint32_t stop = std::min(end, (x / 64 + 1) * 64);
        const uint64_t bits = ~uint64_t{0} >> (64 - (stop - x)) << x % 64;
        const size_t word = size_t{row} * kWordsPerRow + x / 64;
        twice_[word] |= once_[word] & bits;
        once_[word] |= bits;
        x = stop;
    }
}

double CoverageGrid::overlap_area() const {
    uint64_t count = 0;
    for (const uint64_t word : twice_) count += static_cast<uint64_t>(std::popcount(word));
    return static_cast<double>(count) * step_.x * step_.y;
}

}  // namespace tetralight::detail
