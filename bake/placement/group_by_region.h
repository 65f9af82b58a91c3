// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// How regions are cut out and named.
struct RegionRule {
    std::string name;
    /// Metres along the side of the cubes that spaces are cut into, from the world's origin; 0 =
    /// not cut.
    double size = 0.0;
};

/// Probes by region: "grid" when there is one space, or else "grid space 1" for that with most
/// probes and so on, followed by the cube it is cut to: "grid 0,-1,2". Within a group probes keep
/// their order. `order` (one a probe) says where each of them went: the probes of all groups one
/// after the other.
struct RegionGroups {
    std::vector<ProbeGroup> groups;
    std::vector<uint32_t> order;
};

/// Precondition: one space a position.
[[nodiscard]] RegionGroups group_by_region(std::span<const glm::dvec3> positions,
                                           std::span<const uint32_t> spaces,
                                           const RegionRule& rule);

/// The different values of `spaces`: that of most positions first, equal ones by their first
/// position.
[[nodiscard]] std::vector<uint32_t> spaces_by_size(std::span<const uint32_t> spaces);

}  // namespace tetralight
