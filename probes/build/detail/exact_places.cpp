// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/exact_places.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace tetralight::detail {
namespace {

/// Bits after the point of the unit vectors along the steps: as many as floats have. They and the
/// coordinates that multiply them share the 53 bits of a double, less two for the sum of three.
constexpr int kFrameBits = 23;
constexpr int kSharedBits = 51;

/// Coordinates are rounded to steps / 2^13 or finer, alike for all steps of 0.125 to 32 m and for
/// each such range above and below, so that equal ones of neighboring lattices stay equal.
constexpr int kFirstLevel = -3;
constexpr int kLevelSize = 8;
constexpr int kLevelBits = 13;

using Positions = std::span<const glm::dvec3>;

glm::dvec3 rounded(const glm::dvec3& v, double quantum) {
    return nearest_whole(v / quantum) * quantum;
}

glm::dmat3 rounded(const glm::dmat3& m, double quantum) {
    return {rounded(m[0], quantum), rounded(m[1], quantum), rounded(m[2], quantum)};
}

/// The axis that a unit vector lies along; 3 if it lies along none.
int axis_of(const glm::dvec3& direction) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(direction[axis]) == 1.0) return axis;
    }
    return 3;
}

/// A lattice with the indices of its positions, and the directions of its steps.
class Placement {
  public:
    Placement(Positions positions, const Lattice& lattice)
        : positions_(positions), lattice_(lattice), farthest_(0.0) {
        indices_.reserve(positions.size());
        for (const glm::dvec3& p : positions) {
            indices_.push_back(index_of(lattice, p));
            farthest_ = glm::max(farthest_, glm::abs(indices_.back()));
        }
        for (int i = 0; i < 3; ++i) {
            lengths_[i] = glm::length(lattice.steps[i]);
            frame_[i] = lattice.steps[i] / lengths_[i];
        }
        exact_frame_ = rounded(frame_, std::exp2(-kFrameBits));
        for (int i = 0; i < 3; ++i) lies_along_axes_ &= axis_of(exact_frame_[i]) < 3;
    }

    /// True if each coordinate is the same, bit for bit, wherever its index is.
    [[nodiscard]] bool is_exact_grid() const {
        if (!lies_along_axes_) return false;
        for (int step = 0; step < 3; ++step) {
            // Wider lattices than this are hardly grids.
            const auto span = static_cast<size_t>(2.0 * farthest_[step]) + 1;
            if (span > 8 * positions_.size()) return false;
            const int axis = axis_of(exact_frame_[step]);
            std::vector<double> coordinates(span, std::nan(""));
            for (size_t i = 0; i < positions_.size(); ++i) {
                double& known =
                    coordinates[static_cast<size_t>(indices_[i][step] + farthest_[step])];
                if (std::isnan(known)) known = positions_[i][axis];
                if (known != positions_[i][axis]) return false;
            }
        }
        return true;
    }

    /// True if the steps are perpendicular to each other up to rounding.
    [[nodiscard]] bool is_rectangular() const {
        constexpr double kAcross = 1e-4;
        return std::abs(glm::dot(frame_[0], frame_[1])) < kAcross &&
               std::abs(glm::dot(frame_[1], frame_[2])) < kAcross &&
               std::abs(glm::dot(frame_[2], frame_[0])) < kAcross;
    }

    /// Exact unit vectors times rounded coordinates along them, from the world's origin.
    [[nodiscard]] std::vector<glm::dvec3> places_in_frame() const {
        const glm::dvec3 origin = glm::inverse(frame_) * lattice_.origin;
        const double quantum = quantum_for(largest_of(glm::abs(origin) + farthest_ * lengths_));
        std::vector<glm::dvec3> places;
        places.reserve(indices_.size());
        for (const glm::dvec3& index : indices_) {
            places.push_back(exact_frame_ * rounded(origin + index * lengths_, quantum) + 0.0);
        }
        return places;
    }

    /// Sums of a rounded origin and rounded steps: planes across the steps are straight too, and
    /// all is nearer to the lattice, but each lattice has its own planes.
    [[nodiscard]] std::vector<glm::dvec3> places_in_steps() const {
        glm::dvec3 bound = glm::abs(lattice_.origin);
        for (int i = 0; i < 3; ++i) bound += farthest_[i] * glm::abs(lattice_.steps[i]);
        const double quantum = std::exp2(std::ilogb(largest_of(bound)) + 1 - kSharedBits);
        Lattice exact = lattice_;
        exact.origin = rounded(lattice_.origin, quantum);
        exact.steps = rounded(lattice_.steps, quantum);
        std::vector<glm::dvec3> places;
        places.reserve(indices_.size());
        for (const glm::dvec3& index : indices_) places.push_back(place_at(exact, index) + 0.0);
        return places;
    }

    /// How far the farthest of some places is from its position.
    [[nodiscard]] double longest_move(Positions places) const {
        double longest = 0.0;
        for (size_t i = 0; i < places.size(); ++i) {
            longest = std::max(longest, glm::distance(places[i], positions_[i]));
        }
        return longest;
    }

  private:
    /// What coordinates up to `largest` are rounded to. Axes need no bits, and leave more to them.
    [[nodiscard]] double quantum_for(double largest) const {
        const int frame_bits = lies_along_axes_ ? 1 : kFrameBits;
        const int finest = std::ilogb(largest) + 1 - (kSharedBits - frame_bits);
        const int above_first = std::ilogb(shortest_step(lattice_)) - kFirstLevel;
        const int level = kFirstLevel + (above_first & -kLevelSize);
        return std::exp2(std::max(finest, level - kLevelBits - (kFrameBits - frame_bits)));
    }

    Positions positions_;
    const Lattice& lattice_;
    std::vector<glm::dvec3> indices_;
    glm::dvec3 farthest_;  ///< the largest index along each step
    glm::dvec3 lengths_{0.0};
    glm::dmat3 frame_{0.0};
    glm::dmat3 exact_frame_{0.0};
    bool lies_along_axes_ = true;
};

}  // namespace

std::vector<glm::dvec3> exact_places(Positions positions, const Lattice& lattice) {
    const Placement placement(positions, lattice);
    if (placement.is_exact_grid()) return {positions.begin(), positions.end()};
    if (placement.is_rectangular()) {
        std::vector<glm::dvec3> places = placement.places_in_frame();
        if (placement.longest_move(places) <= 1e-3 * shortest_step(lattice)) return places;
    }
    return placement.places_in_steps();
}

}  // namespace tetralight::detail
