// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Finds the cells that walks may visit, so that a part of a volume can hold all of them
/// (probes/build/cut_world.h). Keeps memory of 12 bytes a cell between calls.
class WalkReach {
  public:
    /// Precondition: the volume has tetrahedra, passes `verify`, and outlives this object.
    explicit WalkReach(const ProbeVolumeView& volume);

    /// The cells that a walk from `start` to any position of a local box, about the size of a
    /// voxel, may visit, and some more. Valid until the next call.
    ///
    /// A walk leaves a tetrahedron by a face only if the position lies beyond it and its signed
    /// volume is the least, up to rounding: each face of which that holds for a part of the box is
    /// followed. In a Delaunay tetrahedralization each step brings the walk to a circumsphere with
    /// a smaller power of the position, which excludes cells far from the box. Of hull cells, whose
    /// walls are curved, the weights of nine positions of the box decide, with a tolerance.
    ///
    /// Near the hull, cells are long and flat, and many may be visited: the search stops after some
    /// hundred for each eighth of the box, those of the fewest steps first.
    [[nodiscard]] std::span<const uint32_t> cells_from(uint32_t start,
                                                       const Box<glm::dvec3>& region);

  private:
    void follow(uint32_t start, const Box<glm::dvec3>& region);
    void list_walks(uint32_t start, const Box<glm::dvec3>& region);
    void list_visits();
    [[nodiscard]] bool walk_all(uint32_t start, const Box<glm::dvec3>& region, size_t limit);
    void visit(uint32_t cell);
    void enter(uint32_t tetrahedron);
    void walk_inside(uint32_t start, const Box<glm::dvec3>& region, size_t limit);
    void leave_hull_cell(uint32_t cell, const Box<glm::dvec3>& region);

    ProbeVolumeView volume_;
    // The number of the last call, pass and walk that came to each cell.
    std::vector<uint32_t> listed_;
    std::vector<uint32_t> visited_;
    std::vector<uint32_t> reached_;
    uint32_t call_ = 0;
    uint32_t pass_ = 0;  ///< to a part of the box
    uint32_t walk_ = 0;  ///< of a pass, from one tetrahedron
    std::vector<uint32_t> cells_;
    std::vector<uint32_t> visits_;      ///< of the pass
    std::vector<uint32_t> hull_cells_;  ///< those of them, in order
    std::vector<uint32_t> entries_;     ///< tetrahedra where walks begin or come from a hull cell
    std::vector<uint32_t> queue_;
};

/// True if a tetrahedron may touch a local box: its own box does, and no plane of a face separates
/// them. True for some that nearly touch it. Precondition: `cell` is a tetrahedron.
[[nodiscard]] bool may_touch(const ProbeVolumeView& volume, uint32_t cell,
                             const Box<glm::dvec3>& box);

}  // namespace tetralight
