// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/flat_triangle.h>

namespace tetralight::detail {

namespace {

constexpr double kThinnest = 1e-6;

/// True if the line through an edge of `a` has all of `b` on its outer side.
bool is_separated_by_edge(const FlatTriangle& a, const FlatTriangle& b) noexcept {
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 from = a[k];
        const glm::dvec2 to = a[(k + 1) % 3];
        const double limit = kThinnest * glm::dot(to - from, to - from);
        if (twice_signed_area(from, to, b[0]) <= limit &&
            twice_signed_area(from, to, b[1]) <= limit &&
            twice_signed_area(from, to, b[2]) <= limit) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool overlap(const FlatTriangle& a, const FlatTriangle& b) noexcept {
    return !is_separated_by_edge(a, b) && !is_separated_by_edge(b, a);
}

}  // namespace tetralight::detail
