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

/// Points of a space that are tried. All of them are on the same side of closed surfaces.
constexpr size_t kMaxTries = 256;

/// Evenly chosen free points of a space, in their order.
std::vector<glm::dvec3> free_places(const TraceScene& traced, const std::vector<glm::dvec3>& points,
                                    const FreePositionRule& rule) {
    std::vector<glm::dvec3> places;
    const size_t tries = std::min(points.size(), kMaxTries);
    for (size_t i = 0; i < tries && places.size() < rule.max_count; ++i) {
        const glm::dvec3& point = points[i * points.size() / tries];
        if (is_free_with_clearance(traced, point, rule.clearance)) places.push_back(point);
    }
    return places;
}

}  // namespace

std::vector<SpacePositions> find_free_positions(const TraceScene& traced, const FreeSpaceMap& map,
                                                std::span<const uint32_t> filled,
                                                const FreePositionRule& rule) {
    std::vector<std::pair<uint32_t, std::vector<glm::dvec3>>> points;
    for (auto& [space, positions] : map.points_by_space(rule.bounds)) {
        if (std::ranges::binary_search(filled, space)) continue;
        points.emplace_back(space, std::move(positions));
    }
    std::vector<SpacePositions> found(points.size());
    parallel_for(points.size(), rule.thread_count, [&](size_t i) {
        const auto& [space, positions] = points[i];
        found[i] = {space, free_places(traced, positions, rule), positions.size()};
    });
    std::erase_if(found, [](const SpacePositions& space) { return space.positions.empty(); });
    return found;
}

void sort_farthest_first(std::vector<glm::dvec3>& places, std::span<const glm::dvec3> taken,
                         size_t count) {
    glm::dvec3 center(0.0);
    for (const glm::dvec3& place : places) center += place / static_cast<double>(places.size());
    std::vector<double> room(places.size(), std::numeric_limits<double>::infinity());
    const auto take = [&](const glm::dvec3& position) {
        for (size_t i = 0; i < places.size(); ++i) {
            room[i] = std::min(room[i], glm::distance(places[i], position));
        }
    };
    for (const glm::dvec3& position : taken) take(position);
    if (taken.empty()) take(center);
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
