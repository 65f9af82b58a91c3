// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/group_by_region.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Rank of the space, then the cube.
using Region = std::tuple<size_t, int64_t, int64_t, int64_t>;

Region region_of(const glm::dvec3& position, size_t rank, double size) {
    if (size == 0.0) return {rank, 0, 0, 0};
    const auto cube = [&](double x) { return static_cast<int64_t>(std::floor(x / size)); };
    return {rank, cube(position.x), cube(position.y), cube(position.z)};
}

std::string name_of(const Region& region, const RegionRule& rule, size_t space_count) {
    const auto [rank, x, y, z] = region;
    std::string name = rule.name;
    if (space_count > 1) name += str_cat(" space ", rank + 1);
    if (rule.size > 0.0) name += str_cat(" ", x, ",", y, ",", z);
    return name;
}

}  // namespace

std::vector<uint32_t> spaces_by_size(std::span<const uint32_t> spaces) {
    std::map<uint32_t, size_t> counts;
    std::vector<uint32_t> order;
    for (const uint32_t space : spaces) {
        if (counts[space]++ == 0) order.push_back(space);
    }
    std::ranges::stable_sort(order, std::greater{}, [&](uint32_t space) { return counts[space]; });
    return order;
}

RegionGroups group_by_region(std::span<const glm::dvec3> positions,
                             std::span<const uint32_t> spaces, const RegionRule& rule) {
    TETRALIGHT_ASSERT(positions.size() == spaces.size(), "one space for each position");
    const std::vector<uint32_t> ranked = spaces_by_size(spaces);
    std::map<uint32_t, size_t> rank_of;
    for (size_t i = 0; i < ranked.size(); ++i) rank_of[ranked[i]] = i;
    std::map<Region, std::vector<uint32_t>> regions;
    for (uint32_t i = 0; i < positions.size(); ++i) {
        regions[region_of(positions[i], rank_of[spaces[i]], rule.size)].push_back(i);
    }
    RegionGroups result;
    for (const auto& [region, probes] : regions) {
        ProbeGroup& group = result.groups.emplace_back();
        group.name = name_of(region, rule, ranked.size());
        for (const uint32_t probe : probes) group.positions.push_back(positions[probe]);
        result.order.insert(result.order.end(), probes.begin(), probes.end());
    }
    return result;
}

}  // namespace tetralight
