// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/hilbert.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Where walks without a hint start: every eighth probe with one of its cells, along a Hilbert
/// curve. Their density follows that of the probes and does not depend on the bounding box.
struct Seeds {
    HilbertCube cube;
    std::vector<Seed> seeds;
};

/// `positions` are local, as the volume stores them; `cells` the volume's inner cells.
[[nodiscard]] Seeds make_seeds(std::span<const glm::vec3> positions, std::span<const Cell> cells);

}  // namespace tetralight
