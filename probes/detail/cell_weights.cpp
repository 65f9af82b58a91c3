// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/cell_weights.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include <tetralight/probes/detail/hull_cell.h>

namespace tetralight::detail {
namespace {

/// Squares of the rounding errors of signed volumes are in proportion to this: each volume is a
/// product of three corners.
double product_of_longest_squares(const std::array<glm::dvec3, 4>& corners) {
    std::array<double, 4> squares;
    for (size_t i = 0; i < 4; ++i) squares[i] = glm::dot(corners[i], corners[i]);
    std::ranges::sort(squares);
    return squares[1] * squares[2] * squares[3];
}

}  // namespace

double CellWeights::inside_measure() const {
    const double total = sum();
    if (!(total > 0.0) || !(total * total > rounding)) {
        return -std::numeric_limits<double>::infinity();
    }
    return std::min({weights.x, weights.y, weights.z, weights.w}) / total;
}

int CellWeights::most_negative() const {
    int lowest = 0;
    for (int i = 1; i < 4; ++i) {
        if (weights[i] < weights[lowest]) lowest = i;
    }
    return lowest;
}

CellWeights tetrahedron_weights(const std::array<glm::dvec3, 4>& corners) noexcept {
    return {signed_volumes(corners), kSliverRounding * product_of_longest_squares(corners)};
}

CellWeights precise_tetrahedron_weights(const std::array<glm::dvec3, 4>& corners) noexcept {
    constexpr double kFinerSteps =
        static_cast<double>(std::numeric_limits<long double>::epsilon()) /
        std::numeric_limits<double>::epsilon();
    std::array<glm::vec<3, long double>, 4> precise;
    std::ranges::copy(corners, precise.begin());
    return {glm::dvec4(signed_volumes(precise)),
            kSliverRounding * kFinerSteps * kFinerSteps * product_of_longest_squares(corners)};
}

CellLocation finish(uint32_t cell, const CellWeights& cell_weights) noexcept {
    const CellWeights clamped{glm::max(cell_weights.weights, glm::dvec4(0.0))};
    // + 0 changes −0 into 0.
    const glm::vec4 weights(clamped.weights / clamped.sum() + 0.0);
    if (!std::isfinite(weights.x + weights.y + weights.z + weights.w)) return {};
    return {cell, 0.0f, weights};
}

glm::dvec4 far_signed_volumes(const std::array<glm::dvec3, 4>& corners,
                              const glm::dvec3& position) noexcept {
    const auto& [a, b, c, d] = corners;
    const glm::dvec3 from_a = a - position;
    return {glm::dot(b - position, glm::cross(c - b, d - b)),
            glm::dot(from_a, glm::cross(d - a, c - a)), glm::dot(from_a, glm::cross(b - a, d - a)),
            glm::dot(from_a, glm::cross(c - a, b - a))};
}

bool is_far(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& position) noexcept {
    constexpr double kFarSquare = 0x1p20;
    double longest = 0.0;
    for (size_t i = 1; i < 4; ++i) {
        const glm::dvec3 edge = corners[i] - corners[0];
        longest = std::max(longest, glm::dot(edge, edge));
    }
    const glm::dvec3 away = corners[0] - position;
    return glm::dot(away, away) > kFarSquare * longest;
}

std::optional<glm::dvec3> weights_from_nearest_corner(const std::array<glm::dvec3, 4>& corners,
                                                      const HullCellRays& rays,
                                                      const glm::dvec3& position) noexcept {
    size_t nearest = 2;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 away = corners[i] - position;
        if (!(glm::dot(away, away) < least)) continue;
        least = glm::dot(away, away);
        nearest = i;
    }
    const std::array<size_t, 3> order{(nearest + 1) % 3, (nearest + 2) % 3, nearest};
    const auto turned = hull_cell_weights(
        make_hull_triangle({corners[order[0]], corners[order[1]], corners[order[2]]}, position),
        {{rays.rays[order[0]], rays.rays[order[1]], rays.rays[order[2]]}});
    if (!turned) return std::nullopt;
    glm::dvec3 weights(0.0);
    for (size_t i = 0; i < 3; ++i)
        weights[static_cast<int>(order[i])] = (*turned)[static_cast<int>(i)];
    return weights;
}

}  // namespace tetralight::detail
