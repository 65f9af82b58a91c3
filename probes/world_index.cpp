// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world_index.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/farthest_position.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_members.h>

namespace tetralight {
namespace {

using detail::section_error;

constexpr detail::SectionFileKind kWorldIndexKind{
    {'T', 'E', 'T', 'R', 'A', 'W', 'I', '\n'}, 1, "world index"};

constexpr auto kWorldIndexMembers = [](auto visit) {
    visit("tiles", &WorldIndexView::tiles);
    visit("borders", &WorldIndexView::borders);
    visit("outside_voxels", &WorldIndexView::outside_voxels);
    visit("tile_names", &WorldIndexView::tile_names);
};

/// The borders along one axis.
std::span<const double> borders_along(const WorldIndexView& index, size_t axis) {
    size_t begin = 0;
    for (size_t a = 0; a < axis; ++a) begin += index.info.tile_counts[a] - 1;
    return index.borders.subspan(begin, index.info.tile_counts[axis] - 1);
}

/// The tile of a local position in the box of all probes.
uint32_t tile_inside(const WorldIndexView& index, const glm::dvec3& local) {
    uint32_t tile = 0;
    uint32_t stride = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto borders = borders_along(index, axis);
        const auto above = std::ranges::upper_bound(borders, local[static_cast<int>(axis)]);
        tile += stride * static_cast<uint32_t>(above - borders.begin());
        stride *= index.info.tile_counts[axis];
    }
    return tile;
}

bool is_in_box(const WorldInfo& info, const glm::dvec3& local) {
    return local.x >= info.box_min.x && local.y >= info.box_min.y && local.z >= info.box_min.z &&
           local.x <= info.box_max.x && local.y <= info.box_max.y && local.z <= info.box_max.z;
}

std::array<uint32_t, 3> voxel_of(const SeedGridHeader& grid, const glm::vec3& local) {
    std::array<uint32_t, 3> voxel{};
    for (size_t axis = 0; axis < 3; ++axis) {
        voxel[axis] = seed_voxel(local[static_cast<int>(axis)], grid.min[axis], grid.scale[axis],
                                 grid.size[axis]);
    }
    return voxel;
}

/// The word of a voxel among those that a tile inside has.
uint64_t word_inside(const WorldTile& tile, const std::array<uint32_t, 3>& voxel) {
    uint64_t word = 0;
    for (size_t axis = 3; axis-- > 0;) {
        const uint32_t along = voxel[axis] - tile.first_voxel[axis];
        if (along >= tile.voxel_counts[axis]) return 0;
        word = word * tile.voxel_counts[axis] + along;
    }
    return kSeedGridHeaderWords + word;
}

uint64_t word_outside(const WorldIndexView& index, const std::array<uint32_t, 3>& voxel) {
    const auto& size = index.info.seed_grid.size;
    const uint64_t key = (uint64_t{voxel[2]} * size[1] + voxel[1]) * size[0] + voxel[0];
    const auto found = std::ranges::lower_bound(index.outside_voxels, key);
    if (found == index.outside_voxels.end() || *found != key) return 0;
    return kSeedGridHeaderWords + static_cast<uint64_t>(found - index.outside_voxels.begin());
}

Status check_world_counts(const WorldIndexView& index) {
    uint64_t count = 1;
    uint64_t border_count = 0;
    for (const uint32_t along : index.info.tile_counts) {
        if (along == 0 || along > kNoIndex / 4) {
            return section_error("info", str_cat(along, " tiles along an axis"));
        }
        count *= along;
        border_count += along - 1;
        if (count >= index.tiles.size()) break;
    }
    if (count + 1 != index.tiles.size()) {
        return section_error("tiles",
                             str_cat(index.tiles.size(), " elements instead of ", count + 1));
    }
    if (border_count != index.borders.size()) {
        return section_error("borders",
                             str_cat(index.borders.size(), " elements instead of ", border_count));
    }
    const size_t names = split_names(index.tile_names).size();
    if (names == index.tiles.size()) return Ok{};
    return section_error("tile_names", str_cat(names, " names for ", index.tiles.size(), " tiles"));
}

Status check_world_numbers(const WorldIndexView& index) {
    const WorldInfo& info = index.info;
    const auto is_near = [](const glm::dvec3& p) {
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        return is_finite(p) && farthest <= kFarthestPosition;
    };
    if (!is_near(info.world_origin) || !is_near(info.box_min) || !is_near(info.box_max) ||
        !std::isfinite(info.extent) || info.extent < 0.0f || !is_finite(info.ambient)) {
        return section_error("info", "a number is out of range");
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto borders = borders_along(index, axis);
        const auto a = static_cast<int>(axis);
        double before = info.box_min[a];
        for (const double border : borders) {
            if (!(border >= before) || !(border <= info.box_max[a])) {
                return section_error("borders", "is not ascending");
            }
            before = border;
        }
        if (!(before <= info.box_max[a])) return section_error("info", "the box is empty");
        const SeedGridHeader& grid = info.seed_grid;
        const bool is_grid = std::isfinite(grid.min[axis]) && std::isfinite(grid.scale[axis]) &&
                             grid.scale[axis] >= 0.0f && grid.size[axis] > 0 &&
                             grid.size[axis] <= kSeedGridLongestSide;
        if (!is_grid) return section_error("info", "the seed grid is out of range");
    }
    return Ok{};
}

Status check_tile_name(std::string_view name, size_t tile) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    };
    if (!name.empty() && name[0] != '.' && std::ranges::all_of(name, is_plain)) return Ok{};
    return detail::element_error("tile_names", tile, "is not the name of a tile");
}

}  // namespace

WorldPlace find_place(const WorldIndexView& index, const glm::vec3& position) noexcept {
    if (!is_finite(position) || index.tiles.empty()) return {};
    const glm::dvec3 local = glm::dvec3(position) - index.info.world_origin;
    VolumeInfo info;
    info.extent = index.info.extent;
    WorldPlace place;
    place.seed_position = glm::vec3(detail::within_reach(info, local).position);
    const auto voxel = voxel_of(index.info.seed_grid, place.seed_position);
    if (is_in_box(index.info, local)) {
        place.tile = tile_inside(index, local);
        place.seed_word = word_inside(index.tiles[place.tile], voxel);
    } else {
        place.tile = static_cast<uint32_t>(index.tiles.size() - 1);
        place.seed_word = word_outside(index, voxel);
    }
    return place;
}

uint32_t start_cell(const ProbeVolumeView& tile, const WorldPlace& place) noexcept {
    return place.seed_word == 0 ? 0
                                : seed_cell(tile.seed_grid, place.seed_word, place.seed_position);
}

Box<glm::dvec3> tile_box(const WorldIndexView& index, uint32_t tile) noexcept {
    Box<glm::dvec3> box{index.info.box_min, index.info.box_max};
    for (size_t axis = 0; axis < 3; ++axis) {
        const uint32_t count = index.info.tile_counts[axis];
        const uint32_t along = tile % count;
        tile /= count;
        const auto borders = borders_along(index, axis);
        const auto a = static_cast<int>(axis);
        if (along > 0) box.min[a] = borders[along - 1];
        if (along + 1 < count) box.max[a] = borders[along];
    }
    return box;
}

double distance_to_tile(const WorldIndexView& index, uint32_t tile,
                        const glm::dvec3& position) noexcept {
    const glm::dvec3 local = position - index.info.world_origin;
    if (tile + 1 < index.tiles.size()) {
        const Box<glm::dvec3> box = tile_box(index, tile);
        return glm::distance(local, glm::clamp(local, box.min, box.max));
    }
    // To the nearest side of the box of all probes, from inside.
    const glm::dvec3 from_min = local - index.info.box_min;
    const glm::dvec3 from_max = index.info.box_max - local;
    const double least =
        std::min({from_min.x, from_min.y, from_min.z, from_max.x, from_max.y, from_max.z});
    return std::max(least, 0.0);
}

Status verify(const WorldIndexView& index) {
    if (auto status = check_world_counts(index); !status) return status;
    if (auto status = check_world_numbers(index); !status) return status;
    const auto names = split_names(index.tile_names);
    for (size_t tile = 0; tile < names.size(); ++tile) {
        if (auto status = check_tile_name(names[tile], tile); !status) return status;
    }
    if (std::ranges::is_sorted(index.outside_voxels)) return Ok{};
    return section_error("outside_voxels", "is not sorted");
}

std::vector<std::byte> world_index_bytes(const WorldIndexView& index) {
    return detail::joined(detail::image_of_view(kWorldIndexKind, index, {}, kWorldIndexMembers));
}

Result<WorldIndex> read_world_index(const std::string& path) {
    const auto file =
        detail::map_sections<WorldIndexView>(kWorldIndexKind, path, kWorldIndexMembers);
    if (!file) return file.error();
    if (auto status = detail::verify_sections(kWorldIndexKind, file->mapping.bytes(), file->view);
        !status) {
        return status.error().in(shown_path(path));
    }
    const WorldIndexView& view = file->view;
    return WorldIndex{view.info,
                      {view.tiles.begin(), view.tiles.end()},
                      {view.borders.begin(), view.borders.end()},
                      {view.outside_voxels.begin(), view.outside_voxels.end()},
                      std::string(view.tile_names)};
}

}  // namespace tetralight
