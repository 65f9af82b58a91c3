// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/world_index.h>

// A world: a large probe volume in tiles that are opened and closed as a camera moves, with the
// answers of the one volume (docs/worlds.md):
//
//     auto world = World::open("level_world");
//     if (!world) return world.error();
//     world->move_to(camera, 100.0);                    // each frame, or on a thread of its own
//     auto report = interpolate(*world->tiles(), {.positions = positions, .irradiance = light});

namespace tetralight {

/// The tiles of a world that are open at one time. Does not change; queries are thread-safe. Its
/// files stay open as long as it lives.
class WorldTiles {
  public:
    [[nodiscard]] WorldIndexView index() const noexcept { return index_->view(); }

    /// The file of a tile; null if it is not open. Precondition: the tile exists.
    [[nodiscard]] const ProbeFile* find(uint32_t tile) const noexcept { return files_[tile].get(); }

    [[nodiscard]] bool is_open(uint32_t tile) const noexcept { return files_[tile] != nullptr; }

    /// For each cell of an open tile its index in the volume that was cut; empty if its file does
    /// not have them. Precondition: the tile is open.
    [[nodiscard]] std::span<const uint32_t> volume_cells(uint32_t tile) const noexcept;

    /// The same for probes.
    [[nodiscard]] std::span<const uint32_t> volume_probes(uint32_t tile) const noexcept;

    /// Bytes of the files that are open.
    [[nodiscard]] uint64_t open_size() const noexcept;
    [[nodiscard]] uint32_t open_count() const noexcept;

  private:
    friend class World;

    std::shared_ptr<const WorldIndex> index_;
    std::vector<std::shared_ptr<const ProbeFile>> files_;
};

struct WorldOptions {
    /// A tile is closed when it is farther than radius + hysteresis, metres, ≥ 0.
    double hysteresis = 8.0;
    /// Files that are open have at most so many bytes together: the nearest ones.
    uint64_t max_size = std::numeric_limits<uint64_t>::max();
    /// Verifies each tile when it opens (`open_probe_file`), which reads all of it: for files that
    /// are not trusted. Without it damaged tiles give wrong light.
    bool is_verified = false;
};

/// What a call of `World::move_to` did.
struct WorldMove {
    uint32_t opened_count = 0;
    uint32_t closed_count = 0;
    /// Tiles within the radius that stay closed, because `WorldOptions::max_size` is reached.
    uint32_t left_out_count = 0;
    /// Why tiles could not be opened. Messages begin with the path.
    std::vector<Error> failures;
};

/// A folder of tiles. `tiles` may be called beside the others; they must not overlap.
class World {
  public:
    /// Reads the index; opens no tile. Returns not_found or unavailable if there is none, corrupt
    /// if it is wrong. Messages begin with the path.
    [[nodiscard]] static Result<World> open(const std::string& folder,
                                            const WorldOptions& options = {});

    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    [[nodiscard]] WorldIndexView index() const noexcept;

    /// Opens the tiles within `radius` metres of a world position, the nearest first, and closes
    /// those that are farther than radius + hysteresis. Opening maps a file and reads two pages of
    /// it; memory grows as queries read. Queries of earlier `tiles` go on.
    WorldMove move_to(const glm::dvec3& position, double radius);

    /// Opens these tiles and closes all others. Precondition: they exist.
    WorldMove open_only(std::span<const uint32_t> tiles);

    /// What is open now: never null.
    [[nodiscard]] std::shared_ptr<const WorldTiles> tiles() const;

    /// Gives back the memory of all that was read of open tiles; queries read it again.
    void release_pages() const;

  private:
    struct State;

    explicit World(std::unique_ptr<State> state) noexcept;

    std::unique_ptr<State> state_;
};

/// True if a folder has the index of a world.
[[nodiscard]] bool is_world(const std::string& folder);

}  // namespace tetralight
