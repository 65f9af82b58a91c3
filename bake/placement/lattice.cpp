// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/lattice.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr const char* kAxisNames[] = {"x", "y", "z"};
/// Bounds that are thinner than this fraction of the spacing are flat.
constexpr double kFlatFraction = 0.001;

Status check_lattice(const WorldBox& bounds, const glm::dvec3& spacing) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(spacing[axis] > 0.0) || !std::isfinite(spacing[axis])) {
            return Error{ErrorCode::InvalidArgument, "spacing", str_cat(spacing[axis]),
                         str_cat("spacing ", spacing[axis], " along ", kAxisNames[axis],
                                 " is not a positive length")};
        }
        const double min = bounds.min[axis], max = bounds.max[axis];
        if (!std::isfinite(min) || !std::isfinite(max) || max < min) {
            return Error{ErrorCode::InvalidArgument, "bounds", str_cat(min, ", ", max),
                         str_cat("bounds ", min, " to ", max, " along ", kAxisNames[axis],
                                 " are empty or not finite")};
        }
    }
    return Ok{};
}

bool is_flat(double size, double spacing) {
    return size < kFlatFraction * spacing;
}

/// The number of layers that fit; may exceed every integer type.
double layer_count(double size, double spacing) {
    if (is_flat(size, spacing)) return 1.0;
    // Bounds come from float vertices: a size just above a multiple of the spacing counts as one.
    return std::max(2.0, std::ceil(size / spacing - 1e-6));
}

/// The spacing, reduced along axes where two layers would not fit.
glm::dvec3 fitting_spacing(const WorldBox& bounds, const glm::dvec3& spacing) {
    glm::dvec3 fitting = spacing;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.size()[axis];
        if (is_flat(size, spacing[axis])) continue;
        const bool holds_two = size / spacing[axis] + 1e-6 >= 2.0;
        if (!holds_two) fitting[axis] = 0.5 * size;
    }
    return fitting;
}

/// A power of two whose multiples are exact floats everywhere in the bounds.
double float_step(const WorldBox& bounds) {
    double farthest = std::numeric_limits<double>::min();
    for (int axis = 0; axis < 3; ++axis) {
        farthest = std::max({farthest, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
    }
    constexpr int kFloatBits = 24;
    return std::ldexp(1.0, std::ilogb(farthest) + 1 - kFloatBits);
}

double rounded(double value, double step) {
    return std::round(value / step) * step;
}

LatticeAxis layers_along(const WorldBox& bounds, double spacing, double count, double step,
                         int axis) {
    // Rounding would change a spacing of few steps visibly.
    constexpr double kFewSteps = 1024.0;
    const bool is_rounded = spacing > kFewSteps * step;
    if (is_rounded) spacing = rounded(spacing, step);
    const double first = bounds.min[axis] + 0.5 * (bounds.size()[axis] - (count - 1.0) * spacing);
    return {is_rounded ? rounded(first, step) : first, spacing, static_cast<uint64_t>(count)};
}

}  // namespace

glm::dvec3 Lattice::at(uint64_t i) const {
    const uint64_t row = i / axes[0].count;
    return {axes[0].at(i % axes[0].count), axes[1].at(row / axes[2].count),
            axes[2].at(row % axes[2].count)};
}

std::vector<glm::dvec3> Lattice::positions() const {
    std::vector<glm::dvec3> positions(count());
    for (uint64_t i = 0; i < positions.size(); ++i) positions[i] = at(i);
    return positions;
}

uint64_t index_at(const Lattice& lattice, const glm::ivec3& layers) {
    return (static_cast<uint64_t>(layers.y) * lattice.axes[2].count + layers.z) *
               lattice.axes[0].count +
           layers.x;
}

bool is_in(const Lattice& lattice, const glm::ivec3& layers) {
    for (int axis = 0; axis < 3; ++axis) {
        if (layers[axis] < 0 || layers[axis] >= static_cast<int64_t>(lattice.axes[axis].count)) {
            return false;
        }
    }
    return true;
}

glm::ivec3 layers_of(const Lattice& lattice, uint64_t i) {
    const uint64_t row = i / lattice.axes[0].count;
    return {i % lattice.axes[0].count, row / lattice.axes[2].count, row % lattice.axes[2].count};
}

Result<double> lattice_count(const WorldBox& bounds, const glm::dvec3& spacing) {
    if (auto status = check_lattice(bounds, spacing); !status) return status.error();
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        count *= layer_count(bounds.size()[axis], spacing[axis]);
    }
    return count;
}

Result<Lattice> make_lattice(const WorldBox& bounds, const glm::dvec3& spacing,
                             uint64_t max_count) {
    const auto count = lattice_count(bounds, spacing);
    if (!count) return count.error();
    if (auto status = check_candidate_count(*count, max_count); !status) return status.error();
    const double step = float_step(bounds);
    const glm::dvec3 fitting = fitting_spacing(bounds, spacing);
    Lattice lattice;
    for (int axis = 0; axis < 3; ++axis) {
        const double layers = layer_count(bounds.size()[axis], spacing[axis]);
        lattice.axes[axis] = layers_along(bounds, fitting[axis], layers, step, axis);
    }
    return lattice;
}

}  // namespace tetralight
