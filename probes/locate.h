// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "probes/probe_volume.h"

namespace tetralight {

/// A position as a blend of probes: Σ weights[i] · probe(cells[cell].vertices[i]).
struct CellLocation {
    /// kNoIndex: the volume has no cell, or the position is not finite; the answer is ambient.
    uint32_t cell = kNoIndex;
    /// ≥ 0, sum 1; the fourth is 0 in hull cells. All 0 when there is no cell.
    glm::vec4 weights{0.0f};

    bool operator==(const CellLocation&) const = default;
};

/// Finds the cell that holds a world position, and the weights of its probes.
///
/// Walks from cell to cell, beginning at `hint`: the cell of the last query near by, or of the same
/// object in the last frame. Any value is allowed; without a cell's index the walk begins at the
/// volume's nearest seed. Ends always: after a bounded number of steps all
/// cells are searched. Cost: the number of cells between the hint and the position. Thread-safe.
[[nodiscard]] CellLocation locate(const ProbeVolumeView& volume, glm::vec3 position,
                                  uint32_t hint = kNoIndex) noexcept;

}  // namespace tetralight
