// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/probes/probe_group.h>

namespace tetralight::test {

/// A group that stands as it is in the world.
inline ProbeGroup make_group(std::string name, std::vector<glm::dvec3> positions) {
    ProbeGroup group;
    group.name = std::move(name);
    group.positions = std::move(positions);
    return group;
}

}  // namespace tetralight::test
