// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// The size and the name of regions.
struct RegionRule {
    std::string name;
    /// Side of the cubes that split spaces into regions, metres, from the world's origin; 0 = not
    /// split.
    double size = 0.0;
};

/// Probes grouped by region. A group is named "grid" if there is one space, else "grid space 1" for
/// the space with most probes and so on, followed by its cube: "grid 0,-1,2". Probes keep their
/// order within a group. `order` has the index of each probe of all groups, one group after the
/// other.
struct RegionGroups {
    std::vector<ProbeGroup> groups;
    std::vector<uint32_t> order;
};

/// Precondition: `spaces` has one element for each position.
[[nodiscard]] RegionGroups group_by_region(std::span<const glm::dvec3> positions,
                                           std::span<const uint32_t> spaces,
                                           const RegionRule& rule);

/// The distinct values of `spaces` by their number of positions, the largest first; ties by their
/// first position.
[[nodiscard]] std::vector<uint32_t> spaces_by_size(std::span<const uint32_t> spaces);

}  // namespace tetralight
