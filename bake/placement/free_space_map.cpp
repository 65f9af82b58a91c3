// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/free_space_map.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/grid_bounds.h>

namespace tetralight {
namespace {

constexpr double kStep = 0.5;
constexpr double kMaxPoints = 1 << 20;
/// Points closer to a surface than this fraction of a step belong to neither side.
constexpr float kOnSurface = 1e-4f;

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

Lattice make_lattice_around(const WorldBox& bounds, const glm::dvec3& spacing) {
    glm::dvec3 step;
    for (int axis = 0; axis < 3; ++axis) step[axis] = std::min(spacing[axis], kStep);
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

/// Where a point lies in the order of the lattice, by its layers.
uint64_t index_at(const Lattice& lattice, const glm::ivec3& layer) {
    return (static_cast<uint64_t>(layer.y) * lattice.axes[2].count + layer.z) *
               lattice.axes[0].count +
           layer.x;
}

bool is_in(const Lattice& lattice, const glm::ivec3& layer) {
    for (int axis = 0; axis < 3; ++axis) {
        if (layer[axis] < 0 || layer[axis] >= static_cast<int64_t>(lattice.axes[axis].count)) {
            return false;
        }
    }
    return true;
}

glm::ivec3 layers_of(const Lattice& lattice, uint64_t i) {
    const uint64_t row = i / lattice.axes[0].count;
    return {i % lattice.axes[0].count, row / lattice.axes[2].count, row % lattice.axes[2].count};
}

}  // namespace

FreeSpaceMap::FreeSpaceMap(const TraceScene& traced, const WorldBox& bounds,
                           const glm::dvec3& spacing, uint32_t thread_count)
    : traced_(traced), lattice_(make_lattice_around(bounds, spacing)) {
    fill(thread_count);
}

glm::vec3 FreeSpaceMap::point(uint64_t i) const {
    return traced_.render_from_world(lattice_.at(i));
}

void FreeSpaceMap::fill(uint32_t thread_count) {
    const auto count = static_cast<uint32_t>(lattice_.count());
    const std::vector<glm::ivec3> offsets = later_neighbors();
    const float on_surface = kOnSurface * static_cast<float>(std::min({lattice_.axes[0].spacing,
                                                                       lattice_.axes[1].spacing,
                                                                       lattice_.axes[2].spacing}));
    std::vector<uint8_t> blocked(count, 0);
    std::vector<uint16_t> links(count, 0);
    parallel_for(count, thread_count, [&](size_t i) {
        const glm::vec3 here = point(i);
        const auto nearest = traced_.nearest_surface(here);
        blocked[i] = nearest && glm::distance(*nearest, here) < on_surface;
        const glm::ivec3 layers = layers_of(lattice_, i);
        for (size_t n = 0; n < offsets.size() && blocked[i] == 0; ++n) {
            const glm::ivec3 there = layers + offsets[n];
            if (!is_in(lattice_, there) ||
                !is_visible(traced_, here, point(index_at(lattice_, there)))) {
                continue;
            }
            links[i] = static_cast<uint16_t>(links[i] | 1u << n);
        }
    });
    parent_.resize(count);
    for (uint32_t i = 0; i < count; ++i) parent_[i] = i;
    is_blocked_.assign(blocked.begin(), blocked.end());
    for (uint32_t i = 0; i < count; ++i) {
        for (size_t n = 0; n < offsets.size(); ++n) {
            if ((links[i] >> n & 1u) == 0) continue;
            const uint64_t there = index_at(lattice_, layers_of(lattice_, i) + offsets[n]);
            if (!is_blocked_[there]) unite(i, static_cast<uint32_t>(there));
        }
    }
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

void FreeSpaceMap::append_visible(const glm::dvec3& position, int reach,
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
                if (is_blocked_[i]) continue;
                const glm::vec3 to = point(i);
                if (to == from || is_visible(traced_, from, to))
                    points.push_back(static_cast<uint32_t>(i));
            }
        }
    }
}

std::vector<uint32_t> FreeSpaceMap::visible_points(const glm::dvec3& position) const {
    std::vector<uint32_t> points;
    for (int reach = 0; reach <= 1 && points.empty(); ++reach)
        append_visible(position, reach, points);
    return points;
}

void FreeSpaceMap::join(std::span<const glm::dvec3> positions, uint32_t thread_count) {
    std::vector<std::vector<uint32_t>> seen(positions.size());
    parallel_for(positions.size(), thread_count,
                 [&](size_t i) { seen[i] = visible_points(positions[i]); });
    for (const std::vector<uint32_t>& points : seen) {
        for (const uint32_t point : points) unite(points.front(), point);
    }
}

uint32_t FreeSpaceMap::space_of(const glm::dvec3& position) const {
    const std::vector<uint32_t> points = visible_points(position);
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
        if (!is_blocked_[i] && is_in(box, position)) spaces[root(i)].push_back(position);
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
