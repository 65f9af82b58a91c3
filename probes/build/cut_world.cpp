// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/cut_world.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/cut_cells.h>
#include <tetralight/probes/build/detail/seed_voxels.h>
#include <tetralight/probes/build/detail/select_probes.h>
#include <tetralight/probes/section_file.h>
#include <tetralight/probes/volume_members.h>
#include <tetralight/probes/walk_reach.h>

namespace tetralight {
namespace {

constexpr const char* kAxisNames[] = {"x", "y", "z"};

Error cannot_cut(std::string field, std::string value, std::string message) {
    return {ErrorCode::InvalidArgument, std::move(field), std::move(value), std::move(message)};
}

Box<glm::dvec3> box_of_probes(const ProbeVolumeView& volume) {
    auto box = Box<glm::dvec3>::empty();
    for (const glm::vec3& p : volume.positions) box = union_of(box, glm::dvec3(p));
    return box;
}

uint32_t farthest_probe(const ProbeVolumeView& volume) {
    uint32_t farthest = 0;
    for (uint32_t probe = 1; probe < volume.probe_count(); ++probe) {
        if (glm::length(volume.positions[probe]) > glm::length(volume.positions[farthest])) {
            farthest = probe;
        }
    }
    return farthest;
}

/// Sets the number of tiles and the borders between them.
Status lay_out_tiles(const glm::dvec3& tile_size, WorldIndex& index) {
    uint64_t count = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<int>(axis);
        const double side = tile_size[a];
        if (!(side > 0.0)) {
            return cannot_cut(
                "tile_size", str_cat(side),
                str_cat("tiles of ", side, " m along ", kAxisNames[axis], " have no size"));
        }
        const double length = index.info.box_max[a] - index.info.box_min[a];
        const double along = std::max(std::ceil(length / side), 1.0);
        if (along * static_cast<double>(count) > static_cast<double>(kMostTiles)) {
            return cannot_cut("tile_size", str_cat(side),
                              str_cat("tiles of ", side, " m along ", kAxisNames[axis],
                                      " would be more than ", kMostTiles, " tiles"));
        }
        index.info.tile_counts[axis] = static_cast<uint32_t>(along);
        count *= index.info.tile_counts[axis];
        for (uint32_t i = 1; i < index.info.tile_counts[axis]; ++i) {
            index.borders.push_back(index.info.box_min[a] + i * side);
        }
    }
    index.tiles.resize(static_cast<size_t>(count) + 1);  // at most kMostTiles
    return Ok{};
}

/// Bytes of the volume as a file.
uint64_t file_size(const ProbeVolumeView& volume) {
    constexpr uint64_t kAlign = detail::kAlignment;
    uint64_t size = sizeof(detail::FileHeader) + sizeof(detail::SectionEntry) + sizeof volume.info;
    for_each_volume_member([&](const char*, MemberUse, auto, auto member) {
        const std::span elements = volume.*member;
        if (elements.empty()) return;
        size = (size + kAlign - 1) / kAlign * kAlign + elements.size_bytes();
        size += sizeof(detail::SectionEntry);
    });
    return (size + kAlign - 1) / kAlign * kAlign;
}

WorldInfo world_info(const ProbeVolumeView& volume) {
    WorldInfo info;
    info.world_origin = volume.info.world_origin;
    const Box<glm::dvec3> box = box_of_probes(volume);
    info.box_min = box.min;
    info.box_max = box.max;
    info.volume_size = file_size(volume);
    info.probe_count = volume.probe_count();
    info.cell_count = static_cast<uint32_t>(volume.cells.size());
    info.inner_cell_count = volume.info.inner_cell_count;
    info.extent = volume.info.extent;
    info.seed_grid = seed_grid_header(volume.seed_grid, 0);
    info.ambient = volume.info.ambient;
    return info;
}

}  // namespace

struct WorldCutter::State {
    /// Marks elements of a list by their place in it.
    struct Places {
        std::vector<uint32_t> place;
        std::vector<uint32_t> list;

        void add(uint32_t element) {
            if (place[element] != kNoIndex) return;
            place[element] = 0;
            list.push_back(element);
        }

        void sort() {
            std::ranges::sort(list);
            for (uint32_t i = 0; i < list.size(); ++i) place[list[i]] = i;
        }

        void clear() {
            for (const uint32_t element : list) place[element] = kNoIndex;
            list.clear();
        }
    };

    ProbeVolumeView volume;
    WorldIndex index;
    WalkReach reach;
    detail::SeedVoxels voxels;
    uint32_t farthest = 0;
    /// Rounding of local positions, metres.
    double rounding = 0.0;
    /// Tetrahedra that touch each tile.
    std::vector<std::vector<uint32_t>> touching;
    Places cells;
    Places probes;

    explicit State(const ProbeVolumeView& view)
        : volume(view), reach(volume), voxels(volume), farthest(farthest_probe(view)) {
        rounding = 4e-7 * static_cast<double>(volume.info.extent);
        cells.place.assign(volume.cells.size(), kNoIndex);
        probes.place.assign(volume.positions.size(), kNoIndex);
    }

    [[nodiscard]] Box<glm::dvec3> box_around(uint32_t tile) const {
        Box<glm::dvec3> box = tile_box(index.view(), tile);
        box.min -= glm::dvec3(rounding);
        box.max += glm::dvec3(rounding);
        return box;
    }

    void find_touching() {
        touching.resize(index.tiles.size());
        for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) enter(cell);
    }

    /// The first and the last tile along each axis whose box overlaps that of a tetrahedron.
    void enter(uint32_t cell) {
        auto box = Box<glm::dvec3>::empty();
        for (const uint32_t probe : volume.cells[cell].vertices) {
            box = union_of(box, glm::dvec3(volume.positions[probe]));
        }
        std::array<uint32_t, 3> first{}, last{};
        auto borders = index.borders.begin();
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            const auto end = borders + index.info.tile_counts[axis] - 1;
            const auto tile = [&](double coordinate) {
                return static_cast<uint32_t>(std::upper_bound(borders, end, coordinate) - borders);
            };
            first[axis] = tile(box.min[a] - rounding);
            last[axis] = tile(box.max[a] + rounding);
            borders = end;
        }
        const bool is_in_one = first == last;
        for (uint32_t z = first[2]; z <= last[2]; ++z) {
            for (uint32_t y = first[1]; y <= last[1]; ++y) {
                for (uint32_t x = first[0]; x <= last[0]; ++x) {
                    const auto& counts = index.info.tile_counts;
                    const uint32_t tile = (z * counts[1] + y) * counts[0] + x;
                    if (is_in_one || may_touch(volume, cell, box_around(tile))) {
                        touching[tile].push_back(cell);
                    }
                }
            }
        }
    }

    /// Voxels of the outermost seed grid with positions outside of the box of all probes.
    void find_outside_voxels() {
        const SeedGridHeader& grid = index.info.seed_grid;
        std::array<std::vector<bool>, 3> is_outside;
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            for (uint32_t i = 0; i < grid.size[axis]; ++i) {
                std::array<uint32_t, 3> voxel{};
                voxel[axis] = i;
                const Box<glm::dvec3> region = voxels.region(grid, voxel);
                is_outside[axis].push_back(region.min[a] < index.info.box_min[a] ||
                                           region.max[a] > index.info.box_max[a]);
            }
        }
        for_each_voxel({{}, grid.size}, [&](uint32_t x, uint32_t y, uint32_t z, uint32_t voxel) {
            if (is_outside[0][x] || is_outside[1][y] || is_outside[2][z]) {
                index.outside_voxels.push_back(voxel);
            }
        });
    }

    /// Calls use(x, y, z, index in the grid) for voxels of the outermost seed grid.
    template <class Use>
    void for_each_voxel(const detail::VoxelRange& range, const Use& use) const {
        const SeedGridHeader& grid = index.info.seed_grid;
        const auto& [first, counts] = range;
        for (uint32_t z = first[2]; z < first[2] + counts[2]; ++z) {
            for (uint32_t y = first[1]; y < first[1] + counts[1]; ++y) {
                for (uint32_t x = first[0]; x < first[0] + counts[0]; ++x) {
                    use(x, y, z, (z * grid.size[1] + y) * grid.size[0] + x);
                }
            }
        }
    }

    void keep_walks_from(uint32_t start, const Box<glm::dvec3>& region) {
        for (const uint32_t cell : reach.cells_from(start, region)) cells.add(cell);
    }

    void keep_inside(uint32_t tile) {
        for (const uint32_t cell : touching[tile]) cells.add(cell);
        voxels.for_each_start(box_around(tile), [&](uint32_t start, const Box<glm::dvec3>& part) {
            keep_walks_from(start, part);
        });
    }

    /// All hull cells, and what walks from the voxels at the border visit.
    void keep_outside() {
        for (uint32_t cell = volume.info.inner_cell_count; cell < volume.cells.size(); ++cell) {
            cells.add(cell);
        }
        const SeedGridHeader& grid = index.info.seed_grid;
        const Box<glm::dvec3> box = outside_box();
        for (const uint32_t voxel : index.outside_voxels) {
            const std::array<uint32_t, 3> at{voxel % grid.size[0],
                                             voxel / grid.size[0] % grid.size[1],
                                             voxel / grid.size[0] / grid.size[1]};
            voxels.visit_voxel(
                grid, 0, at, box, 1,
                [&](uint32_t start, const Box<glm::dvec3>& part) { keep_walks_from(start, part); });
        }
    }

    /// The positions outside whose walks are followed: a voxel wide around the box of all probes,
    /// from where walks go on over hull cells.
    [[nodiscard]] Box<glm::dvec3> outside_box() const {
        const SeedGridHeader& grid = index.info.seed_grid;
        Box<glm::dvec3> box{index.info.box_min, index.info.box_max};
        for (size_t axis = 0; axis < 3; ++axis) {
            const double voxel =
                grid.scale[axis] > 0.0f ? 1.0 / static_cast<double>(grid.scale[axis]) : 0.0;
            box.min[static_cast<int>(axis)] -= voxel + rounding;
            box.max[static_cast<int>(axis)] += voxel + rounding;
        }
        return box;
    }

    /// With each hull cell the tetrahedron before it, and with each tetrahedron the hull cells
    /// behind its faces.
    void complete_cells() {
        for (size_t i = 0; i < cells.list.size(); ++i) {
            const uint32_t cell = cells.list[i];
            const auto& neighbors = volume.cells[cell].neighbors;
            if (cell >= volume.info.inner_cell_count) {
                cells.add(neighbors[3]);
                continue;
            }
            for (const uint32_t neighbor : neighbors) {
                if (neighbor >= volume.info.inner_cell_count) cells.add(neighbor);
            }
        }
        cells.sort();
        for (const uint32_t cell : cells.list) {
            for (const uint32_t probe : volume.cells[cell].vertices) {
                if (probe != kNoIndex) probes.add(probe);
            }
        }
        probes.add(farthest);  // tiles have the extent of the volume
        probes.sort();
    }

    [[nodiscard]] WorldTile seed_entry(uint32_t tile) const {
        WorldTile entry;
        if (tile + 1 < index.tiles.size()) {
            const auto range = voxels.range(index.info.seed_grid, box_around(tile));
            entry.first_voxel = range.first;
            entry.voxel_counts = range.counts;
            return entry;
        }
        constexpr uint32_t kRow = 1u << 16;
        const auto count =
            std::max<uint32_t>(1, static_cast<uint32_t>(index.outside_voxels.size()));
        entry.voxel_counts = {std::min(count, kRow), (count + kRow - 1) / kRow, 1};
        return entry;
    }

    [[nodiscard]] std::vector<uint32_t> seed_grid(uint32_t tile, const WorldTile& entry) const {
        SeedGridHeader header;
        header.size = entry.voxel_counts;
        if (tile + 1 == index.tiles.size()) {
            return detail::cut_seed_grid(volume, header, index.outside_voxels, cells.place);
        }
        const SeedGridHeader& grid = index.info.seed_grid;
        header.scale = grid.scale;
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto first = static_cast<float>(entry.first_voxel[axis]);
            header.min[axis] =
                grid.scale[axis] > 0.0f ? grid.min[axis] + first / grid.scale[axis] : 0.0f;
        }
        std::vector<uint32_t> chosen;
        for_each_voxel(
            {entry.first_voxel, entry.voxel_counts},
            [&](uint32_t, uint32_t, uint32_t, uint32_t voxel) { chosen.push_back(voxel); });
        return detail::cut_seed_grid(volume, header, chosen, cells.place);
    }
};

WorldCutter::WorldCutter(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}

WorldCutter::WorldCutter(WorldCutter&&) noexcept = default;
WorldCutter& WorldCutter::operator=(WorldCutter&&) noexcept = default;
WorldCutter::~WorldCutter() = default;

Result<WorldCutter> WorldCutter::make(const ProbeVolumeView& volume,
                                      const WorldSettings& settings) {
    if (volume.info.dimension != Dimension::Space) {
        return cannot_cut("volume", "", "a volume without tetrahedra cannot be cut");
    }
    if (volume.seed_grid.size() < kSeedGridHeaderWords) {
        return cannot_cut("volume", "",
                          "the volume has no seed grid, as files of older versions; make it again");
    }
    auto state = std::make_unique<State>(volume);
    state->index.info = world_info(volume);
    if (auto status = lay_out_tiles(settings.tile_size, state->index); !status) {
        return status.error();
    }
    state->find_touching();
    state->find_outside_voxels();
    return WorldCutter(std::move(state));
}

uint32_t WorldCutter::tile_count() const noexcept {
    return static_cast<uint32_t>(state_->index.tiles.size());
}

const WorldIndex& WorldCutter::index() const noexcept {
    return state_->index;
}

CutTile WorldCutter::cut(uint32_t tile) {
    TETRALIGHT_ASSERT(tile < tile_count(), "there is such a tile");
    State& state = *state_;
    const ProbeVolumeView& volume = state.volume;
    if (tile + 1 < tile_count()) {
        state.keep_inside(tile);
    } else {
        state.keep_outside();
    }
    state.complete_cells();

    CutTile cut;
    cut.entry = state.seed_entry(tile);
    cut.probes = state.probes.list;
    cut.cells = state.cells.list;
    cut.volume = detail::select_probes(volume, cut.probes, state.probes.place);
    detail::CutCells cells =
        detail::cut_cells(volume, cut.cells, state.cells.place, state.probes.place);
    cut.volume.cells = std::move(cells.cells);
    cut.volume.hull_rays = std::move(cells.hull_rays);
    cut.volume.info.inner_cell_count = cells.inner_cell_count;
    detail::select_visibility(volume, cut.cells, cut.volume);
    cut.volume.seed_grid = state.seed_grid(tile, cut.entry);
    cut.entry.probe_count = cut.volume.view().probe_count();
    cut.entry.cell_count = cells.cell_count;
    cut.entry.inner_cell_count = cells.inner_cell_count;
    cut.cells.resize(cut.volume.cells.size(), kNoIndex);
    state.cells.clear();
    state.probes.clear();
    return cut;
}

}  // namespace tetralight
