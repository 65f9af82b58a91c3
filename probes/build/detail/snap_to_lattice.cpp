// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/snap_to_lattice.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/build/detail/exact_places.h>
#include <tetralight/probes/build/detail/lattice_fit.h>

namespace tetralight::detail {
namespace {

/// Fewer positions are too few to call them a lattice.
constexpr size_t kFewest = 8;

/// Number of positions around the center that decide if the others are examined.
constexpr size_t kFirstCount = 64;

using Positions = std::span<const glm::dvec3>;

/// Orders positions by their distance from one place.
struct NearerTo {
    glm::dvec3 place;

    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
        const double p = glm::dot(a - place, a - place), q = glm::dot(b - place, b - place);
        return std::tie(p, a.x, a.y, a.z) < std::tie(q, b.x, b.y, b.z);
    }
};

/// Positions relative to the one nearest to the center of their bounds.
class CenteredPositions {
  public:
    explicit CenteredPositions(Positions positions) : positions_(positions) {
        auto bounds = Box<glm::dvec3>::empty();
        for (const glm::dvec3& p : positions) bounds = union_of(bounds, p);
        center_ = *std::ranges::min_element(positions, NearerTo{bounds.center()});
        for (const glm::dvec3& p : positions)
            squares_.push_back(glm::dot(p - center_, p - center_));
    }

    [[nodiscard]] const glm::dvec3& middle() const { return center_; }

    /// The nearest ones, relative to the center, nearest first.
    [[nodiscard]] std::vector<glm::dvec3> nearest(size_t count) const {
        std::vector<double> sorted = squares_;
        count = std::min(count, sorted.size());
        std::ranges::nth_element(sorted, sorted.begin() + static_cast<ptrdiff_t>(count - 1));
        std::vector<glm::dvec3> result = within(sorted[count - 1]);
        std::ranges::sort(result, NearerTo{glm::dvec3(0.0)});
        result.resize(count);
        return result;
    }

    /// Those not farther away than the root of `square`, relative to the center.
    [[nodiscard]] std::vector<glm::dvec3> within(double square) const {
        std::vector<glm::dvec3> result;
        for (size_t i = 0; i < positions_.size(); ++i) {
            if (squares_[i] <= square) result.push_back(positions_[i] - center_);
        }
        return result;
    }

    /// The square of the smallest distance that is longer than the root of `square`; infinite if
    /// no distance is longer.
    [[nodiscard]] double square_beyond(double square) const {
        double smallest = std::numeric_limits<double>::infinity();
        for (const double s : squares_) {
            if (s > square) smallest = std::min(smallest, s);
        }
        return smallest;
    }

  private:
    Positions positions_;
    glm::dvec3 center_{0.0};
    std::vector<double> squares_;  ///< of the distances from the center
};

/// The lattice that positions are near to, if they are. A fit to the positions within some distance
/// is good enough to number those within twice that, so that errors never grow to a tenth of a
/// step.
std::optional<Lattice> find_lattice(Positions positions) {
    double float_step = 0.0;
    for (const glm::dvec3& p : positions) {
        float_step = std::max({float_step, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    float_step *= 0x1p-23;
    const CenteredPositions visibility(positions);
    const std::vector<glm::dvec3> first = visibility.nearest(kFirstCount);
    LatticeFit fit(first);
    const auto is_near = [&] {
        const double tolerance = std::min(float_step, 1e-3 * shortest_step(fit.lattice()));
        return fit.largest_error() <= tolerance;
    };
    if (!fit.fit(first) || !is_near()) return {};

    double square = glm::dot(first.back(), first.back());
    double beyond = visibility.square_beyond(square);
    while (std::isfinite(beyond)) {
        square = std::max(4.0 * square, beyond);
        if (!fit.fit(visibility.within(square)) || !is_near()) return {};
        beyond = visibility.square_beyond(square);
    }
    Lattice lattice = fit.lattice();
    lattice.origin += visibility.middle();
    return lattice;
}

}  // namespace

std::optional<double> snap_to_lattice(std::span<glm::dvec3> positions) {
    if (positions.size() < kFewest) return {};
    const auto lattice = find_lattice(positions);
    if (!lattice) return {};
    const std::vector<glm::dvec3> places = exact_places(positions, *lattice);
    double longest = 0.0;
    for (size_t i = 0; i < positions.size(); ++i) {
        longest = std::max(longest, glm::distance(positions[i], places[i]));
        positions[i] = places[i];
    }
    return longest;
}

}  // namespace tetralight::detail
