// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/world_index.h>

// Cuts a probe volume into the tiles of a world, whose answers are those of the volume, to the bit
// (docs/worlds.md):
//
//     auto cutter = WorldCutter::make(volume, {.tile_size = glm::dvec3(64)});
//     if (!cutter) return cutter.error();
//     for (uint32_t tile = 0; tile < cutter->tile_count(); ++tile) ... cutter->cut(tile) ...

namespace tetralight {

/// The most tiles of a world.
inline constexpr uint64_t kMostTiles = 1u << 16;

struct WorldSettings {
    /// Sides of a tile, metres, > 0. The last tile along each axis may be smaller. Infinite: one
    /// tile along the axis.
    glm::dvec3 tile_size{64.0};
};

/// One tile of a world.
struct CutTile {
    ProbeVolume volume;
    /// For each cell its index in the volume that was cut; kNoIndex for cells at the cut.
    std::vector<uint32_t> cells;
    /// The same for probes.
    std::vector<uint32_t> probes;
    /// Without the size of its file.
    WorldTile entry;
};

/// Cuts one tile at a time. Keeps about 20 bytes a cell of the volume.
class WorldCutter {
  public:
    /// Returns invalid_argument if the volume has no tetrahedra or no seed grid, if a tile has no
    /// size, or if there would be more than kMostTiles. Precondition: the volume passes `verify`
    /// and outlives this object.
    [[nodiscard]] static Result<WorldCutter> make(const ProbeVolumeView& volume,
                                                  const WorldSettings& settings);

    WorldCutter(WorldCutter&&) noexcept;
    WorldCutter& operator=(WorldCutter&&) noexcept;
    ~WorldCutter();

    /// With the tile outside, which is the last.
    [[nodiscard]] uint32_t tile_count() const noexcept;

    /// Every tetrahedron that touches the box of the tile, every cell that walks to its positions
    /// may visit, and everything that the volume holds for these. Precondition: tile < tile_count.
    [[nodiscard]] CutTile cut(uint32_t tile);

    /// The index of the world, without entries and names of its tiles.
    [[nodiscard]] const WorldIndex& index() const noexcept;

  private:
    struct State;

    explicit WorldCutter(std::unique_ptr<State> state) noexcept;

    std::unique_ptr<State> state_;
};

}  // namespace tetralight
