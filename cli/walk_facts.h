// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::cli {

/// What finding positions without a hint takes in one volume. The positions are drawn at random,
/// the same ones every time.
struct WalkFacts {
    /// Positions drawn for each of the two blocks below.
    uint32_t position_count = 0;

    // Positions in inner cells, each cell as likely as any other: they are as dense as the probes.
    double seed_hit_rate = 0.0;    ///< fraction of positions whose seed is their own cell
    double steps_from_seed = 0.0;  ///< mean number of cells tested

    // Positions evenly in the box around the probes, 10 % longer on each axis.
    uint32_t median_steps = 0;  ///< cells tested
    uint32_t p99_steps = 0;
    uint32_t most_steps = 0;
    uint32_t fallback_count = 0;  ///< walks that ended in a search of all cells
};

/// Precondition: the volume has a cell.
[[nodiscard]] WalkFacts measure_walks(const ProbeVolumeView& volume);

}  // namespace tetralight::cli
