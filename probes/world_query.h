// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/receiver.h>
#include <tetralight/probes/sh.h>
#include <tetralight/probes/world.h>

namespace tetralight {

/// How a world answered a position.
enum class WorldState : uint8_t {
    Answered,   ///< as the volume that was cut, to the bit
    NotFinite,  ///< ambient light: the position is not finite
    Closed,     ///< ambient light: its tile is not open
    /// Ambient light: its walk left the tile. Where probes are so nearly coplanar that cells are
    /// thinner than rounding, or far outside of all probes.
    Lost,
};

/// Where a world answered a position.
struct WorldLocation {
    uint32_t tile = kNoIndex;
    /// The cell is that of the tile (`WorldTiles::volume_cells`).
    CellLocation location;

    bool operator==(const WorldLocation&) const = default;
};

/// Many positions in one call.
struct WorldBatch {
    /// World space.
    std::span<const glm::vec3> positions;
    /// Out, as long as `positions`, or empty.
    std::span<IrradianceSh> irradiance = {};
    std::span<glm::vec4> occlusion = {};
    std::span<WorldState> states = {};
    std::span<WorldLocation> locations = {};
    /// Policies other than Extrapolate need the tile outside to be open, for positions outside the
    /// hull of the probes.
    OutsideHull outside = {};
    /// What is at every position.
    Receiver receiver = {};
    /// Which copy of the light tiles are read for: half precision if they have it, or floats.
    enum class Precision : uint8_t { Fast, Full } precision = Precision::Fast;
};

/// Counters of a batch.
struct WorldReport {
    uint64_t not_finite_count = 0;
    uint64_t closed_count = 0;
    uint64_t lost_count = 0;

    bool operator==(const WorldReport&) const = default;
};

/// Locates and blends every position in its tile. Thread-safe.
///
/// Returns invalid_argument if an output is shorter than `positions`, the fade distance is not
/// positive and finite, or the radius is negative or not finite.
[[nodiscard]] Result<WorldReport> interpolate(const WorldTiles& tiles, const WorldBatch& batch);

/// The tiles that answer some positions, ascending, each once.
[[nodiscard]] std::vector<uint32_t> tiles_of(const WorldIndexView& index,
                                             std::span<const glm::vec3> positions);

}  // namespace tetralight
