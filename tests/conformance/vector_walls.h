// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include <tetralight/probes/probe_volume.h>
#include "tests/conformance/numbers.h"

namespace tetralight::conformance {

/// An infinite wall: positions p with dot(normal, p) = offset.
struct WallPlane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
};

/// Edge visibility of a volume whose edges these walls block. Precondition: no probe is on a wall.
void add_walls(ProbeVolume& volume, std::span<const WallPlane> walls);

/// Random codes, more than a third of them of blocked edges, and random splits.
void add_random_walls(ProbeVolume& volume, Numbers& numbers);

}  // namespace tetralight::conformance
