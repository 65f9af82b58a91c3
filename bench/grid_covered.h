// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bench/grid_error.h>

namespace tetralight::bench {

/// A grid of a scene with its light.
struct BakedGrid {
    const GridSubject& subject;
    std::string name;  ///< "regular_1m"
    /// Minimum distance of its probes to surfaces, metres.
    double clearance = 0.0;
    ProbeVolumeView volume;
};

/// Reports which share of the places at least a centimetre more than the clearance off surfaces
/// the probes light, by rays of its own (`grid.covered`), which are in hull cells
/// (`grid.hull_cells`), and which see too little of their cell (`grid.unseen`).
void report_cover(const BakedGrid& grid, const LightReference& places);

/// Reports the share of the probes that no light reaches (`grid.unlit`).
void report_unlit(const BakedGrid& grid);

}  // namespace tetralight::bench
