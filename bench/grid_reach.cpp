// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_reach.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

constexpr double kStep = 0.25, kMostPoints = 2e6;
constexpr float kOffSurfaces = 0.1f;
constexpr int64_t kReach = 2;

/// Keeps points off the planes and edges of geometry with round coordinates, along which a ray
/// belongs to neither side.
const glm::dvec3 kShift(0.0137, 0.0171, 0.0193);

}  // namespace

ReachableSpace::ReachableSpace(const TraceScene& traced, const WorldBox& bounds,
                               std::span<const glm::dvec3> from, const Filter& is_wanted)
    : traced_(traced) {
    const glm::dvec3 size = bounds.size();
    step_ = std::max(kStep, std::cbrt(size.x * size.y * size.z / kMostPoints));
    for (int axis = 0; axis < 3; ++axis) {
        counts_[axis] = std::max<int64_t>(1, static_cast<int64_t>(size[axis] / step_));
        const double length = static_cast<double>(counts_[axis]) * step_;
        first_[axis] = bounds.min[axis] + 0.5 * (size[axis] - length + step_);
    }
    first_ += kShift * step_;
    is_reached_.assign(point_count(), 0);
    find_links();
    if (from.empty()) {
        flood_largest(is_wanted);
        return;
    }
    for (const glm::dvec3& seed : from) {
        std::vector<size_t> seen = seen_from(
            seed, [&](size_t point) { return is_free_[point] != 0; }, point_count());
        require(!seen.empty(), "a seed in free space");
        flood(std::move(seen));
    }
}

bool ReachableSpace::contains(const glm::dvec3& position) const {
    return !seen_from(
                position, [&](size_t point) { return is_reached_[point] != 0; }, 1)
                .empty();
}

size_t ReachableSpace::point_count() const {
    return static_cast<size_t>(counts_[0] * counts_[1] * counts_[2]);
}

glm::dvec3 ReachableSpace::at(size_t point) const {
    const auto i = static_cast<int64_t>(point);
    const int64_t x = i % counts_[0], y = i / counts_[0] % counts_[1],
                  z = i / (counts_[0] * counts_[1]);
    return first_ + step_ * glm::dvec3(x, y, z);
}

size_t ReachableSpace::index_of(const Steps& steps) const {
    return static_cast<size_t>(steps[0] + counts_[0] * (steps[1] + counts_[1] * steps[2]));
}

bool ReachableSpace::is_free_between(const glm::dvec3& a, const glm::dvec3& b) const {
    const glm::vec3 from = traced_.render_from_world(a), to = traced_.render_from_world(b);
    return from == to || !traced_.caster().intersect_unfiltered({from, to - from, 1.0f});
}

void ReachableSpace::find_links() {
    is_free_.assign(point_count(), 0);
    links_.assign(point_count(), 0);
    parallel_for(point_count(), 0, [&](size_t i) {
        const glm::vec3 here = traced_.render_from_world(at(i));
        const auto surface = traced_.nearest_surface(here);
        is_free_[i] = !surface || glm::distance(*surface, here) >= kOffSurfaces;
    });
    parallel_for(point_count(), 0, [&](size_t i) {
        if (is_free_[i] == 0) return;
        size_t stride = 1, rest = i;
        for (int axis = 0; axis < 3; ++axis) {
            const auto count = static_cast<size_t>(counts_[axis]);
            const bool has_next = rest % count + 1 < count;
            if (has_next && is_free_[i + stride] != 0 && is_free_between(at(i), at(i + stride))) {
                links_[i] = static_cast<uint8_t>(links_[i] | (1 << axis));
            }
            rest /= count;
            stride *= count;
        }
    });
}

std::vector<size_t> ReachableSpace::flood(std::vector<size_t> points) {
    std::erase_if(points, [&](size_t point) { return std::exchange(is_reached_[point], 1) != 0; });
    const auto visit = [&](size_t point) {
        if (std::exchange(is_reached_[point], 1) == 0) points.push_back(point);
    };
    for (size_t done = 0; done < points.size(); ++done) {
        const size_t point = points[done];
        size_t stride = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = 1 << axis;
            if ((links_[point] & bit) != 0) visit(point + stride);
            if (point >= stride && (links_[point - stride] & bit) != 0) visit(point - stride);
            stride *= static_cast<size_t>(counts_[axis]);
        }
    }
    return points;
}

void ReachableSpace::flood_largest(const Filter& is_wanted) {
    std::vector<std::vector<size_t>> spaces;
    for (size_t i = 0; i < point_count(); ++i) {
        if (is_free_[i] != 0 && is_reached_[i] == 0) spaces.push_back(flood({i}));
    }
    std::ranges::stable_sort(spaces, std::ranges::greater{}, &std::vector<size_t>::size);
    const auto chosen = std::ranges::find_if(
        spaces, [&](const std::vector<size_t>& space) { return is_wanted(some_of(space)); });
    require(chosen != spaces.end(), "a space for bodies");
    std::ranges::fill(is_reached_, uint8_t{0});
    for (const size_t point : *chosen) is_reached_[point] = 1;
}

std::vector<glm::dvec3> ReachableSpace::some_of(std::span<const size_t> points) const {
    constexpr size_t kSome = 64;
    std::vector<glm::dvec3> some;
    const size_t step = std::max<size_t>(1, points.size() / kSome);
    for (size_t i = 0; i < points.size(); i += step) some.push_back(at(points[i]));
    return some;
}

template <class Accept>
std::vector<size_t> ReachableSpace::seen_from(const glm::dvec3& position, Accept&& accepts,
                                              size_t most) const {
    Steps low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<int64_t>(std::floor((position[axis] - first_[axis]) / step_));
        low[axis] = std::max<int64_t>(0, cell - kReach + 1);
        high[axis] = std::min(counts_[axis] - 1, cell + kReach);
    }
    std::vector<size_t> seen;
    for (int64_t z = low[2]; z <= high[2]; ++z) {
        for (int64_t y = low[1]; y <= high[1]; ++y) {
            for (int64_t x = low[0]; x <= high[0]; ++x) {
                const size_t point = index_of({x, y, z});
                if (!accepts(point) || !is_free_between(position, at(point))) continue;
                seen.push_back(point);
                if (seen.size() >= most) return seen;
            }
        }
    }
    return seen;
}

}  // namespace tetralight::bench
