// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world.h>

#include <algorithm>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/mutex.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

std::string path_in(const std::string& folder, std::string_view name) {
    return str_cat(folder, folder.ends_with('/') ? "" : "/", name);
}

std::span<const uint32_t> indices_of(const ProbeFile& file, std::string_view section) {
    const auto bytes = file.section_bytes(section, sizeof(uint32_t));
    if (!bytes) return {};
    return {reinterpret_cast<const uint32_t*>(bytes->data()), bytes->size() / sizeof(uint32_t)};
}

/// Opens a tile and compares it with its entry in the index.
Result<ProbeFile> open_tile_file(const std::string& path, const WorldInfo& info,
                                 const WorldTile& tile, bool is_verified) {
    auto file = is_verified ? open_probe_file(path) : open_probe_file_lazy(path);
    if (!file) return file;
    const ProbeVolumeView& volume = file->view();
    const bool is_of_index = volume.probe_count() == tile.probe_count &&
                             volume.info.inner_cell_count == tile.inner_cell_count &&
                             volume.cells.size() >= tile.cell_count &&
                             volume.info.world_origin == info.world_origin &&
                             volume.info.extent == info.extent;
    if (is_of_index) return file;
    return Error{ErrorCode::Corrupt, "tiles", path,
                 shown_path(path) + ": is not the tile that the index of its world lists"};
}

}  // namespace

std::span<const uint32_t> WorldTiles::volume_cells(uint32_t tile) const noexcept {
    return indices_of(*files_[tile], kWorldCellsSection);
}

std::span<const uint32_t> WorldTiles::volume_probes(uint32_t tile) const noexcept {
    return indices_of(*files_[tile], kWorldProbesSection);
}

uint64_t WorldTiles::open_size() const noexcept {
    uint64_t size = 0;
    for (size_t tile = 0; tile < files_.size(); ++tile) {
        if (files_[tile]) size += index_->tiles[tile].file_size;
    }
    return size;
}

uint32_t WorldTiles::open_count() const noexcept {
    return static_cast<uint32_t>(
        std::ranges::count_if(files_, [](const auto& file) { return file != nullptr; }));
}

struct World::State {
    std::string folder;
    WorldOptions options;
    std::shared_ptr<const WorldIndex> index;
    std::vector<std::string> paths;

    mutable Mutex mutex;  ///< of `tiles`
    std::shared_ptr<const WorldTiles> tiles;

    [[nodiscard]] std::shared_ptr<const WorldTiles> current() const {
        const MutexLock lock(mutex);
        return tiles;
    }

    void replace(std::shared_ptr<const WorldTiles> next) {
        const MutexLock lock(mutex);
        tiles.swap(next);  // the old ones are closed without the lock
    }
};

World::World(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}

World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<World> World::open(const std::string& folder, const WorldOptions& options) {
    TETRALIGHT_ASSERT(options.hysteresis >= 0.0, "the hysteresis is a distance");
    auto index = read_world_index(path_in(folder, kWorldIndexName));
    if (!index) return index.error();
    auto state = std::make_unique<State>();
    state->folder = folder;
    state->options = options;
    for (const std::string_view name : split_names(index->tile_names)) {
        state->paths.push_back(path_in(folder, name));
    }
    state->index = std::make_shared<const WorldIndex>(std::move(*index));
    auto tiles = std::make_shared<WorldTiles>();
    tiles->index_ = state->index;
    tiles->files_.resize(state->paths.size());
    state->tiles = std::move(tiles);
    return World(std::move(state));
}

WorldIndexView World::index() const noexcept {
    return state_->index->view();
}

std::shared_ptr<const WorldTiles> World::tiles() const {
    return state_->current();
}

WorldMove World::move_to(const glm::dvec3& position, double radius) {
    const WorldIndexView index = this->index();
    const auto open = state_->current();

    struct Near {
        double distance = 0.0;
        uint32_t tile = 0;
    };

    std::vector<Near> near;
    for (uint32_t tile = 0; tile < index.tiles.size(); ++tile) {
        const double distance = distance_to_tile(index, tile, position);
        const double limit = open->is_open(tile) ? radius + state_->options.hysteresis : radius;
        if (distance <= limit) near.push_back({distance, tile});
    }
    std::ranges::stable_sort(near, {}, &Near::distance);
    std::vector<uint32_t> wanted;
    uint32_t left_out = 0;
    uint64_t room = state_->options.max_size;
    for (const auto& [distance, tile] : near) {
        const uint64_t size = index.tiles[tile].file_size;
        if (size <= room) {
            room -= size;
            wanted.push_back(tile);
        } else {
            left_out += distance <= radius;
        }
    }
    WorldMove move = open_only(wanted);
    move.left_out_count = left_out;
    return move;
}

WorldMove World::open_only(std::span<const uint32_t> wanted) {
    const auto open = state_->current();
    auto next = std::make_shared<WorldTiles>();
    next->index_ = state_->index;
    next->files_.resize(open->files_.size());
    WorldMove move;
    for (const uint32_t tile : wanted) {
        TETRALIGHT_ASSERT(tile < next->files_.size(), "the tile exists");
        if (next->files_[tile]) continue;
        next->files_[tile] = open->files_[tile];
        if (next->files_[tile]) continue;
        auto file = open_tile_file(state_->paths[tile], state_->index->info,
                                   state_->index->tiles[tile], state_->options.is_verified);
        if (!file) {
            move.failures.push_back(file.error());
            continue;
        }
        next->files_[tile] = std::make_shared<const ProbeFile>(std::move(*file));
        ++move.opened_count;
    }
    for (size_t tile = 0; tile < open->files_.size(); ++tile) {
        move.closed_count += open->files_[tile] && !next->files_[tile];
    }
    if (move.opened_count + move.closed_count > 0) state_->replace(std::move(next));
    return move;
}

void World::release_pages() const {
    for (const auto& file : state_->current()->files_) {
        if (file) file->release_pages();
    }
}

bool is_world(const std::string& folder) {
    return bool(MappedFile::open(path_in(folder, kWorldIndexName)));
}

}  // namespace tetralight
