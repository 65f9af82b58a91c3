// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/free_space_map.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/grid_bounds.h>

namespace tetralight {
namespace {

constexpr double kStep = 0.25, kLeastStep = 0.1;
constexpr double kMaxPoints = 1 << 21;
/// Doors of this width have points in them, metres.
constexpr double kDoor = 0.8;
/// A body that touches surfaces passes, in spite of rounding.
constexpr float kRounding = 0.999f;

/// Half of the 26 neighbors: those that come later in the order of the points.
std::vector<glm::ivec3> later_neighbors() {
    std::vector<glm::ivec3> offsets;
    for (int y = 0; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
            for (int x = -1; x <= 1; ++x) {
                const bool is_later = y > 0 || z > 0 || (z == 0 && x > 0);
                if (is_later) offsets.emplace_back(x, y, z);
            }
        }
    }
    return offsets;
}

Lattice make_lattice_around(const FreeSpaceMap::Rule& rule) {
    const WorldBox& bounds = rule.bounds;
    const double widest = std::clamp(kDoor - 2.0 * rule.radius, kLeastStep, kStep);
    glm::dvec3 step;
    for (int axis = 0; axis < 3; ++axis) step[axis] = std::min(rule.spacing[axis], widest);
    const auto count_along = [&](int axis) {
        return std::ceil(bounds.size()[axis] / step[axis]) + 3.0;
    };
    while (count_along(0) * count_along(1) * count_along(2) > kMaxPoints) step *= 1.1;
    Lattice points;
    for (int axis = 0; axis < 3; ++axis) {
        const double count = count_along(axis);
        const double first = bounds.center()[axis] - 0.5 * (count - 1.0) * step[axis];
        points.axes[axis] = {first, step[axis], static_cast<uint64_t>(count)};
    }
    return points;
}

/// The longest way to a neighbor, metres.
double diagonal_of(const Lattice& lattice) {
    return glm::length(
        glm::dvec3(lattice.axes[0].spacing, lattice.axes[1].spacing, lattice.axes[2].spacing));
}

}  // namespace

FreeSpaceMap::FreeSpaceMap(const TraceScene& traced, const Rule& rule)
    : traced_(traced),
      lattice_(make_lattice_around(rule)),
      radius_(static_cast<float>(rule.radius)),
      far_(radius_ + static_cast<float>(diagonal_of(lattice_))) {
    fill(rule.thread_count);
}

glm::vec3 FreeSpaceMap::point(uint64_t i) const {
    return traced_.render_from_world(lattice_.at(i));
}

double FreeSpaceMap::point_volume() const {
    return lattice_.axes[0].spacing * lattice_.axes[1].spacing * lattice_.axes[2].spacing;
}

float FreeSpaceMap::distance_at(glm::vec3 position) const {
    const auto nearest = traced_.nearest_surface(position, far_);
    return nearest ? glm::distance(*nearest, position) : far_;
}

/// Steps along the way, each as long as the room around the ball allows.
bool FreeSpaceMap::passes(glm::vec3 from, glm::vec3 to, float radius) const {
    if (from == to) return true;
    if (!is_visible(traced_, from, to)) return false;
    if (!(radius > 0.0f)) return true;
    constexpr float kShortest = 0.1f;  // of the radius
    const float length = glm::distance(from, to);
    for (float way = 0.0f; way < length;) {
        const float room = distance_at(glm::mix(from, to, way / length)) - kRounding * radius;
        if (room < 0.0f) return false;
        way += std::max(room, kShortest * radius);
    }
    return distance_at(to) >= kRounding * radius;
}

bool FreeSpaceMap::is_linked(uint64_t a, uint64_t b) const {
    const glm::vec3 from = point(a), to = point(b);
    // Between two points the distance falls by at most the way to the nearer one.
    const float narrowest = 0.5f * (distances_[a] + distances_[b] - glm::distance(from, to));
    return (narrowest > 0.0f && narrowest >= radius_) || passes(from, to, radius_);
}

void FreeSpaceMap::fill(uint32_t thread_count) {
    const auto count = static_cast<uint32_t>(lattice_.count());
    const std::vector<glm::ivec3> offsets = later_neighbors();
    distances_.resize(count);
    parallel_for(count, thread_count, [&](size_t i) { distances_[i] = distance_at(point(i)); });
    std::vector<uint16_t> links(count, 0);
    parallel_for(count, thread_count, [&](size_t i) {
        if (!has_room(i)) return;
        const glm::ivec3 layers = layers_of(lattice_, i);
        for (size_t n = 0; n < offsets.size(); ++n) {
            const glm::ivec3 there = layers + offsets[n];
            if (!is_in(lattice_, there)) continue;
            const uint64_t other = index_at(lattice_, there);
            if (!has_room(other) || !is_linked(i, other)) continue;
            links[i] = static_cast<uint16_t>(links[i] | 1u << n);
        }
    });
    parent_.resize(count);
    for (uint32_t i = 0; i < count; ++i) parent_[i] = i;
    for (uint32_t i = 0; i < count; ++i) {
        for (size_t n = 0; n < offsets.size(); ++n) {
            if ((links[i] >> n & 1u) == 0) continue;
            const uint64_t there = index_at(lattice_, layers_of(lattice_, i) + offsets[n]);
            unite(i, static_cast<uint32_t>(there));
        }
    }
}

bool FreeSpaceMap::has_room(uint64_t i) const {
    // Points on a surface belong to neither side.
    const double least =
        std::min({lattice_.axes[0].spacing, lattice_.axes[1].spacing, lattice_.axes[2].spacing});
    constexpr double kOnSurface = 1e-4;
    return distances_[i] >= std::max(kRounding * radius_, static_cast<float>(kOnSurface * least));
}

uint32_t FreeSpaceMap::root(uint32_t point) const {
    while (parent_[point] != point) point = parent_[point];
    return point;
}

void FreeSpaceMap::unite(uint32_t a, uint32_t b) {
    const uint32_t root_a = root(a), root_b = root(b);
    const uint32_t first = std::min(root_a, root_b);
    // Both ways are shortened to the common root, so that later searches are short.
    for (const uint32_t start : {a, b}) {
        for (uint32_t point = start; parent_[point] != first;) {
            const uint32_t next = parent_[point];
            parent_[point] = first;
            if (next == point) break;
            point = next;
        }
    }
}

void FreeSpaceMap::append_reached(const glm::dvec3& position, int reach, float radius,
                                  std::vector<uint32_t>& points) const {
    glm::ivec3 first;
    for (int axis = 0; axis < 3; ++axis) {
        const LatticeAxis& layers = lattice_.axes[axis];
        const double steps = std::floor((position[axis] - layers.first) / layers.spacing);
        first[axis] =
            static_cast<int>(std::clamp(steps, 0.0, static_cast<double>(layers.count) - 2.0));
    }
    const glm::vec3 from = traced_.render_from_world(position);
    for (int y = -reach; y <= reach + 1; ++y) {
        for (int z = -reach; z <= reach + 1; ++z) {
            for (int x = -reach; x <= reach + 1; ++x) {
                const glm::ivec3 layers = first + glm::ivec3(x, y, z);
                if (!is_in(lattice_, layers)) continue;
                const uint64_t i = index_at(lattice_, layers);
                if (has_room(i) && passes(from, point(i), radius))
                    points.push_back(static_cast<uint32_t>(i));
            }
        }
    }
}

std::vector<uint32_t> FreeSpaceMap::reached_points(const glm::dvec3& position, float radius) const {
    // From a corner of a room, points where the body fits are up to its radius away on each axis.
    const double step =
        std::min({lattice_.axes[0].spacing, lattice_.axes[1].spacing, lattice_.axes[2].spacing});
    const int farthest = 1 + static_cast<int>(std::min(std::ceil(radius_ / step), 8.0));
    std::vector<uint32_t> points;
    for (int reach = 0; reach <= farthest && points.empty(); ++reach)
        append_reached(position, reach, radius, points);
    return points;
}

void FreeSpaceMap::join(std::span<const glm::dvec3> positions, uint32_t thread_count) {
    std::vector<std::vector<uint32_t>> reached(positions.size());
    parallel_for(positions.size(), thread_count,
                 [&](size_t i) { reached[i] = reached_points(positions[i], radius_); });
    for (const std::vector<uint32_t>& points : reached) {
        for (const uint32_t point : points) unite(points.front(), point);
    }
}

uint32_t FreeSpaceMap::space_of(const glm::dvec3& position) const {
    constexpr float kFits = 0.9f;
    const float room = distance_at(traced_.render_from_world(position));
    const std::vector<uint32_t> points = reached_points(position, std::min(radius_, kFits * room));
    return points.empty() ? kNoIndex : root(points.front());
}

std::vector<uint32_t> FreeSpaceMap::spaces_of(std::span<const glm::dvec3> positions,
                                              uint32_t thread_count) const {
    std::vector<uint32_t> spaces(positions.size());
    parallel_for(positions.size(), thread_count,
                 [&](size_t i) { spaces[i] = space_of(positions[i]); });
    return spaces;
}

std::map<uint32_t, std::vector<glm::dvec3>> FreeSpaceMap::points_by_space(
    const WorldBox& box) const {
    std::map<uint32_t, std::vector<glm::dvec3>> spaces;
    for (uint32_t i = 0; i < parent_.size(); ++i) {
        const glm::dvec3 position = lattice_.at(i);
        if (has_room(i) && is_in(box, position)) spaces[root(i)].push_back(position);
    }
    return spaces;
}

bool FreeSpaceMap::contains(const glm::dvec3& position) const {
    for (int axis = 0; axis < 3; ++axis) {
        const LatticeAxis& layers = lattice_.axes[axis];
        if (position[axis] < layers.first || position[axis] > layers.at(layers.count - 1)) {
            return false;
        }
    }
    return true;
}

}  // namespace tetralight
