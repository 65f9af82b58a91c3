// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A position as a blend: Σ weights[i] · probe(cells[cell].vertices[i]) + ambient · the volume's
/// ambient light. All are ≥ 0 and their sum is 1.
struct CellLocation {
    /// kNoIndex: the volume has no cell, or the position is not finite; the answer is ambient.
    uint32_t cell = kNoIndex;
    float ambient = 1.0f;
    /// The fourth is 0 in hull cells.
    glm::vec4 weights{0.0f};

    bool operator==(const CellLocation&) const = default;
};

/// The light outside the hull of the probes. Every policy is continuous across the hull.
enum class OutsidePolicy : uint8_t {
    Extrapolate,  ///< the light of the hull, carried outwards along its normals (hull cells)
    Clamp,        ///< the light of the closest point of the hull
    Ambient,      ///< as Clamp, fading to the volume's ambient light
};

struct OutsideHull {
    OutsidePolicy policy = OutsidePolicy::Extrapolate;
    /// Policy Ambient: distance from the hull at which the light has faded to ambient, metres, > 0.
    float fade_distance = 10.0f;

    bool operator==(const OutsideHull&) const = default;
};

/// Finds the cell that contains a world position, and the weights of its probes.
///
/// Walks from cell to cell, beginning at `hint`: the cell of a previous query near by, or of the
/// same object in the last frame. Any value is allowed; if it is not the index of a cell, the walk
/// begins at the cell that the volume's seed grid names. The walk always ends: a walk that
/// cycles goes on with a search of the cells around, then with a second walk from the seed grid,
/// and finally with a search of all cells. Cost: the number of cells between the hint and the
/// position. Thread-safe.
///
/// An answer is a function of the position and the hint, to the bit: single queries and batches
/// give the same. Where cells meet, hints and the GPU may choose another of them, with the same
/// light up to rounding; but nearly coplanar probes make cells thinner than rounding, across which
/// the light changes.
[[nodiscard]] CellLocation locate(const ProbeVolumeView& volume, glm::vec3 position,
                                  uint32_t hint = kNoIndex,
                                  const OutsideHull& outside = {}) noexcept;

/// A location and the cost of finding it.
struct LocationTrace {
    CellLocation location;
    /// Cells that were tested.
    uint32_t step_count = 0;
    /// The walk did not reach the position: all cells were searched.
    bool is_fallback = false;
};

/// `locate` with counters for benchmarks and reports.
[[nodiscard]] LocationTrace trace_location(const ProbeVolumeView& volume, glm::vec3 position,
                                           uint32_t hint = kNoIndex) noexcept;

}  // namespace tetralight
