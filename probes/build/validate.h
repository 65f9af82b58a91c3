// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The counts of `validate`. In a valid volume all of the first block are zero.
struct ValidationReport {
    uint32_t inverted_cells = 0;          ///< not positively oriented
    uint32_t non_delaunay_faces = 0;      ///< a neighbor's vertex strictly inside a circumsphere
    uint32_t concave_hull_edges = 0;      ///< hull triangles that see each other from outside
    uint32_t inward_hull_rays = 0;        ///< rays that point into the hull or out of a flat set
    uint32_t torn_hull_rays = 0;          ///< a vertex has another ray in another hull cell
    uint32_t probes_without_cell = 0;     ///< in no inner cell
    uint32_t probes_without_source = 0;   ///< in no group
    uint32_t misplaced_float_probes = 0;  ///< float position is not the rounded exact one
    uint32_t wrong_compact_probes = 0;    ///< halves are not the rounded floats
    uint32_t wrong_layer_sums = 0;        ///< light is not the weighted sum of the layers
    uint32_t torn_edges = 0;              ///< an edge has another code in another cell

    /// Measure of all inner cells, and of the hull: m³; m² in a plane, m on a line.
    double cell_measure = 0.0;
    double hull_measure = 0.0;
    /// Bound of the rounding error of their difference: large if probes are far apart and the hull
    /// is thin.
    double measure_rounding = 0.0;

    /// One line a kind of problem; empty = valid.
    [[nodiscard]] std::vector<std::string> problems() const;
};

/// Checks the geometry of a volume whose structure is sound (see `verify`): the Delaunay property
/// under exact arithmetic on the stored double positions, orientation, convexity of the hull, hull
/// rays that lead away from it, every probe present, sum of the cells = content of the hull.
/// Compact probes have to equal the rounded floats, and light the weighted sum of its layers. Flat
/// volumes are checked in their plane. Hull rays are not checked if there are none. A volume
/// without exact positions is checked on its float ones.
[[nodiscard]] ValidationReport validate(const ProbeVolumeView& volume);

}  // namespace tetralight
