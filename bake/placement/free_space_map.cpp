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
constexpr double kMaxPosts = 1 << 20;
/// Posts nearer to a surface than this share of a step belong to neither side.
constexpr float kOnSurface = 1e-4f;

/// Half of the 26 neighbors: those that come later in the order of the posts.
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
    while (count_along(0) * count_along(1) * count_along(2) > kMaxPosts) step *= 1.1;
    Lattice posts;
    for (int axis = 0; axis < 3; ++axis) {
        const double count = count_along(axis);
        const double first = bounds.center()[axis] - 0.5 * (count - 1.0) * step[axis];
        posts.axes[axis] = {first, step[axis], static_cast<uint64_t>(count)};
    }
    return posts;
}

/// Where a post lies in the order of the lattice, by its layers.
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
    : traced_(traced), posts_(make_lattice_around(bounds, spacing)) {
    fill(thread_count);
}

glm::vec3 FreeSpaceMap::post(uint64_t i) const {
    return traced_.render_from_world(posts_.at(i));
}

void FreeSpaceMap::fill(uint32_t thread_count) {
    const auto count = static_cast<uint32_t>(posts_.count());
    const std::vector<glm::ivec3> offsets = later_neighbors();
    const float on_surface =
        kOnSurface * static_cast<float>(std::min(
                         {posts_.axes[0].spacing, posts_.axes[1].spacing, posts_.axes[2].spacing}));
    std::vector<uint8_t> blocked(count, 0);
    std::vector<uint16_t> links(count, 0);
    parallel_for(count, thread_count, [&](size_t i) {
        const glm::vec3 here = post(i);
        const auto nearest = traced_.nearest_surface(here);
        blocked[i] = nearest && glm::distance(*nearest, here) < on_surface;
        const glm::ivec3 layers = layers_of(posts_, i);
        for (size_t n = 0; n < offsets.size() && blocked[i] == 0; ++n) {
            const glm::ivec3 there = layers + offsets[n];
            if (!is_in(posts_, there) ||
                !is_visible(traced_, here, post(index_at(posts_, there)))) {
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
            const uint64_t there = index_at(posts_, layers_of(posts_, i) + offsets[n]);
            if (!is_blocked_[there]) unite(i, static_cast<uint32_t>(there));
        }
    }
}

uint32_t FreeSpaceMap::root(uint32_t post) const {
    while (parent_[post] != post) post = parent_[post];
    return post;
}

void FreeSpaceMap::unite(uint32_t a, uint32_t b) {
    const uint32_t root_a = root(a), root_b = root(b);
    const uint32_t first = std::min(root_a, root_b);
    // Both ways are shortened to the common root, so that later searches are short.
    for (const uint32_t start : {a, b}) {
        for (uint32_t post = start; parent_[post] != first;) {
            const uint32_t next = parent_[post];
            parent_[post] = first;
            if (next == post) break;
            post = next;
        }
    }
}

void FreeSpaceMap::look(const glm::dvec3& position, int reach, std::vector<uint32_t>& posts) const {
    glm::ivec3 low;
    for (int axis = 0; axis < 3; ++axis) {
        const LatticeAxis& layers = posts_.axes[axis];
        const double steps = std::floor((position[axis] - layers.first) / layers.spacing);
        low[axis] =
            static_cast<int>(std::clamp(steps, 0.0, static_cast<double>(layers.count) - 2.0));
    }
    const glm::vec3 from = traced_.render_from_world(position);
    for (int y = -reach; y <= reach + 1; ++y) {
        for (int z = -reach; z <= reach + 1; ++z) {
            for (int x = -reach; x <= reach + 1; ++x) {
                const glm::ivec3 layers = low + glm::ivec3(x, y, z);
                if (!is_in(posts_, layers)) continue;
                const uint64_t i = index_at(posts_, layers);
                if (is_blocked_[i]) continue;
                const glm::vec3 to = post(i);
                if (to == from || is_visible(traced_, from, to))
                    posts.push_back(static_cast<uint32_t>(i));
            }
        }
    }
}

std::vector<uint32_t> FreeSpaceMap::visible_points(const glm::dvec3& position) const {
    std::vector<uint32_t> posts;
    for (int reach = 0; reach <= 1 && posts.empty(); ++reach) look(position, reach, posts);
    return posts;
}

void FreeSpaceMap::join(std::span<const glm::dvec3> positions, uint32_t thread_count) {
    std::vector<std::vector<uint32_t>> seen(positions.size());
    parallel_for(positions.size(), thread_count,
                 [&](size_t i) { seen[i] = visible_points(positions[i]); });
    for (const std::vector<uint32_t>& posts : seen) {
        for (const uint32_t post : posts) unite(posts.front(), post);
    }
}

uint32_t FreeSpaceMap::space_of(const glm::dvec3& position) const {
    const std::vector<uint32_t> posts = visible_points(position);
    return posts.empty() ? kNoIndex : root(posts.front());
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
        const glm::dvec3 position = posts_.at(i);
        if (!is_blocked_[i] && is_in(box, position)) spaces[root(i)].push_back(position);
    }
    return spaces;
}

bool FreeSpaceMap::contains(const glm::dvec3& position) const {
    for (int axis = 0; axis < 3; ++axis) {
        const LatticeAxis& layers = posts_.axes[axis];
        if (position[axis] < layers.first || position[axis] > layers.at(layers.count - 1)) {
            return false;
        }
    }
    return true;
}

}  // namespace tetralight
