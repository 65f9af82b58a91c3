// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/empty_spaces.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>

namespace tetralight {
namespace {

/// So many posts of a space are tried: all of them lie on the same side of closed surfaces.
constexpr size_t kMostTries = 256;

/// Evenly chosen ones of a space's posts that are free, in their order.
std::vector<glm::dvec3> free_places(const TraceScene& traced, const std::vector<glm::dvec3>& posts,
                                    const FreePositionRule& rule) {
    std::vector<glm::dvec3> places;
    const size_t tries = std::min(posts.size(), kMostTries);
    for (size_t i = 0; i < tries && places.size() < rule.max_count; ++i) {
        const glm::dvec3& post = posts[i * posts.size() / tries];
        if (is_free_with_clearance(traced, post, rule.clearance)) places.push_back(post);
    }
    return places;
}

}  // namespace

std::vector<SpacePositions> find_free_positions(const TraceScene& traced, const FreeSpaceMap& map,
                                                std::span<const uint32_t> filled,
                                                const FreePositionRule& rule) {
    std::vector<std::pair<uint32_t, std::vector<glm::dvec3>>> posts;
    for (auto& [space, positions] : map.points_by_space(rule.bounds)) {
        if (std::ranges::binary_search(filled, space)) continue;
        posts.emplace_back(space, std::move(positions));
    }
    std::vector<SpacePositions> found(posts.size());
    parallel_for(posts.size(), rule.thread_count, [&](size_t i) {
        const auto& [space, positions] = posts[i];
        found[i] = {space, free_places(traced, positions, rule), positions.size()};
    });
    std::erase_if(found, [](const SpacePositions& space) { return space.positions.empty(); });
    return found;
}

void sort_farthest_first(std::vector<glm::dvec3>& places, std::span<const glm::dvec3> taken,
                         size_t count) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& place : places) middle += place / static_cast<double>(places.size());
    std::vector<double> room(places.size(), std::numeric_limits<double>::infinity());
    const auto take = [&](const glm::dvec3& position) {
        for (size_t i = 0; i < places.size(); ++i) {
            room[i] = std::min(room[i], glm::distance(places[i], position));
        }
    };
    for (const glm::dvec3& position : taken) take(position);
    if (taken.empty()) take(middle);
    for (size_t done = 0; done < std::min(count, places.size()); ++done) {
        const auto best =
            std::max_element(room.begin() + static_cast<std::ptrdiff_t>(done), room.end()) -
            room.begin();
        std::swap(places[done], places[static_cast<size_t>(best)]);
        std::swap(room[done], room[static_cast<size_t>(best)]);
        if (done == 0 && taken.empty())
            std::ranges::fill(room, std::numeric_limits<double>::infinity());
        take(places[done]);
    }
}

}  // namespace tetralight
