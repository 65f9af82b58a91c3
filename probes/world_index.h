// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/seed_grid.h>

// The index of a world: a large probe volume that was cut into tiles, one `.probes` file each
// (docs/worlds.md). Tiles are boxes side by side that fill the box of all probes; one more tile
// holds what is outside of that box.

namespace tetralight {

/// The name of the index in the folder of a world.
inline constexpr std::string_view kWorldIndexName = "world.index";

/// Sections of a tile's file that are not members of a volume: for each cell and each probe of the
/// tile its index in the volume that was cut.
inline constexpr std::string_view kWorldCellsSection = "world_cells";
inline constexpr std::string_view kWorldProbesSection = "world_probes";

/// Facts of the volume that was cut. "Local" is relative to its origin, which its tiles share.
struct WorldInfo {
    glm::dvec3 world_origin{0.0};
    /// The box of all probes, local.
    glm::dvec3 box_min{0.0};
    glm::dvec3 box_max{0.0};
    /// Bytes of the volume as one file.
    uint64_t volume_size = 0;
    /// Tiles along each axis.
    std::array<uint32_t, 3> tile_counts{1, 1, 1};
    uint32_t probe_count = 0;
    uint32_t cell_count = 0;
    uint32_t inner_cell_count = 0;
    float extent = 0.0f;
    /// The outermost grid of the volume's seed grid.
    SeedGridHeader seed_grid;
    /// As that of the volume: the answer where there is no other.
    IrradianceSh ambient;

    bool operator==(const WorldInfo&) const = default;
};

static_assert(sizeof(WorldInfo) == 256 && std::is_trivially_copyable_v<WorldInfo>);

/// One tile.
struct WorldTile {
    uint64_t file_size = 0;
    uint32_t probe_count = 0;
    /// Cells of the volume that the tile holds; behind them are the cells at the cut.
    uint32_t cell_count = 0;
    uint32_t inner_cell_count = 0;
    /// The voxels of the volume's outermost seed grid whose words the tile has. Of the tile
    /// outside: the words of `outside_voxels` in rows.
    std::array<uint32_t, 3> first_voxel{};
    std::array<uint32_t, 3> voxel_counts{1, 1, 1};
    uint32_t reserved = 0;

    bool operator==(const WorldTile&) const = default;
};

static_assert(sizeof(WorldTile) == 48 && std::is_trivially_copyable_v<WorldTile>);

/// Read-only spans over an index.
struct WorldIndexView {
    WorldInfo info;
    /// Tiles, x fastest, then the one outside.
    std::span<const WorldTile> tiles;
    /// Where tiles adjoin, local: ascending along x, then y, then z; one less than tiles each. A
    /// position on a border belongs to the tile above it.
    std::span<const double> borders;
    /// Voxels of the seed grid that reach out of the box of all probes, ascending.
    std::span<const uint32_t> outside_voxels;
    std::string_view tile_names;  ///< files, each ended by '\n'
};

struct WorldIndex {
    WorldInfo info;
    std::vector<WorldTile> tiles;
    std::vector<double> borders;
    std::vector<uint32_t> outside_voxels;
    std::string tile_names;

    [[nodiscard]] WorldIndexView view() const noexcept {
        return {info, tiles, borders, outside_voxels, tile_names};
    }

    bool operator==(const WorldIndex&) const = default;
};

/// Where a world answers a position.
struct WorldPlace {
    uint32_t tile = kNoIndex;  ///< kNoIndex: the position is not finite
    /// The word of the tile's outermost seed grid that begins the walk; 0 if there is none.
    uint64_t seed_word = 0;
    /// Local, as walks look up their seed.
    glm::vec3 seed_position{0.0f};
};

[[nodiscard]] WorldPlace find_place(const WorldIndexView& index,
                                    const glm::vec3& position) noexcept;

/// The cell of a tile in which a walk begins, as that of the uncut volume does.
[[nodiscard]] uint32_t start_cell(const ProbeVolumeView& tile, const WorldPlace& place) noexcept;

/// The local box of a tile inside.
[[nodiscard]] Box<glm::dvec3> tile_box(const WorldIndexView& index, uint32_t tile) noexcept;

/// Metres from a world position to the nearest position of a tile; 0 inside.
[[nodiscard]] double distance_to_tile(const WorldIndexView& index, uint32_t tile,
                                      const glm::dvec3& position) noexcept;

/// Checks an index that may come from a file. Returns corrupt; the field is the section.
[[nodiscard]] Status verify(const WorldIndexView& index);

/// The bytes of the file of an index.
[[nodiscard]] std::vector<std::byte> world_index_bytes(const WorldIndexView& index);

/// Reads an index. Returns corrupt if its bytes are wrong, unsupported if a newer version wrote it.
/// Messages begin with the path.
[[nodiscard]] Result<WorldIndex> read_world_index(const std::string& path);

}  // namespace tetralight
