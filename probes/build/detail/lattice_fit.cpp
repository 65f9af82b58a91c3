// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/lattice_fit.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <tuple>

namespace tetralight::detail {
namespace {

/// Positions must fill at least 1 / this of the places in their box.
constexpr double kPlacesPerPosition = 32.0;

double largest_of(std::span<const glm::dvec3> vectors) {
    double largest = 0.0;
    for (const glm::dvec3& v : vectors) largest = std::max(largest, detail::largest_of(v));
    return largest;
}

bool is_nearer(const glm::dvec3& a, const glm::dvec3& b) {
    const double p = glm::dot(a, a), q = glm::dot(b, b);
    return std::tie(p, a.x, a.y, a.z) < std::tie(q, b.x, b.y, b.z);
}

}  // namespace

bool LatticeFit::fit(std::span<const glm::dvec3> positions) {
    if (!extend_to(positions) || lattice_.rank == 0) return false;
    indices_.clear();
    indices_.reserve(positions.size());
    for (const glm::dvec3& p : positions) indices_.push_back(index_of(lattice_, p));
    const glm::dmat4 weights = inverse_weights();
    measure_errors(positions);
    for (int pass = 0; pass < 2 && largest_error() > 0.0; ++pass) {
        improve(weights);  // the second time, what rounding left of the first
        measure_errors(positions);
    }
    return true;
}

double LatticeFit::largest_error() const {
    return largest_of(errors_);
}

bool LatticeFit::extend_to(std::span<const glm::dvec3> positions) {
    while (true) {
        const glm::dvec3* nearest = nullptr;
        for (const glm::dvec3& p : positions) {
            if (is_near_place(lattice_, p)) continue;
            if (nearest == nullptr || is_nearer(p, *nearest)) nearest = &p;
        }
        if (nearest == nullptr) return true;
        if (!extend(lattice_, *nearest) || !is_filled()) return false;
    }
}

bool LatticeFit::is_filled() const {
    glm::dvec3 low(0.0);
    glm::dvec3 high(0.0);
    for (const glm::dvec3& p : first_) {
        const glm::dvec3 index = index_of(lattice_, p);
        low = glm::min(low, index);
        high = glm::max(high, index);
    }
    const glm::dvec3 counts = high - low + 1.0;
    const double places = counts.x * counts.y * counts.z;
    return places <= kPlacesPerPosition * static_cast<double>(first_.size());
}

glm::dmat4 LatticeFit::inverse_weights() const {
    glm::dmat4 weights(0.0);
    for (const glm::dvec3& index : indices_) {
        const glm::dvec4 row(1.0, index);
        weights += glm::outerProduct(row, row);
    }
    for (int i = lattice_.rank + 1; i < 4; ++i) weights[i][i] = 1.0;
    return glm::inverse(weights);
}

/// Least squares: the origin and steps for which the errors are smallest. These are rounded to
/// multiples of a power of two whose sums a double holds, so that their order does not matter.
void LatticeFit::improve(const glm::dmat4& inverse_weights) {
    const auto count = static_cast<double>(errors_.size());
    const double bound = count * std::max(1.0, largest_of(indices_)) * largest_error();
    const double quantum = std::exp2(std::ilogb(bound) - 51);
    glm::dmat4x3 sums(0.0);
    for (size_t i = 0; i < errors_.size(); ++i) {
        const glm::dvec3 error = nearest_whole(errors_[i] / quantum) * quantum;
        sums += glm::outerProduct(error, glm::dvec4(1.0, indices_[i]));
    }
    const glm::dmat4x3 change = sums * inverse_weights;
    lattice_.origin += change[0];
    glm::dmat3 steps = lattice_.steps;
    for (int i = 0; i < lattice_.rank; ++i) steps[i] += change[i + 1];
    set_steps(lattice_, steps);
}

void LatticeFit::measure_errors(std::span<const glm::dvec3> positions) {
    errors_.resize(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        errors_[i] = positions[i] - place_at(lattice_, indices_[i]);
    }
}

}  // namespace tetralight::detail
