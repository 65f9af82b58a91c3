// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_world.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/section_file.h>
#include <tetralight/probes/world.h>

namespace tetralight {
namespace {

constexpr std::string_view kTilePrefix = "tile-";
constexpr std::string_view kTileSuffix = ".probes";

std::string path_of(const std::string& folder, std::string_view name) {
    return (std::filesystem::path(folder) / name).string();
}

/// Names of the files of a folder.
std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    return names;
}

bool is_tile_name(const std::string& name) {
    return name.starts_with(kTilePrefix) && name.ends_with(kTileSuffix);
}

Status prepare_folder(const std::string& folder) {
    std::error_code error;
    if (std::filesystem::is_directory(folder, error)) {
        const auto names = names_in(folder);
        const bool is_ours = is_world(folder) || std::ranges::all_of(names, is_tile_name);
        if (is_ours) return Ok{};
        return Error{ErrorCode::InvalidArgument, "output", folder,
                     shown_path(folder) + ": is a folder of other files, not a world"};
    }
    if (std::filesystem::exists(folder, error)) {
        return Error{ErrorCode::InvalidArgument, "output", folder,
                     shown_path(folder) + ": is not a folder"};
    }
    std::filesystem::create_directories(folder, error);
    if (!error) return Ok{};
    return Error{ErrorCode::Unavailable, "output", folder,
                 str_cat(shown_path(folder), ": cannot be made: ", error.message())};
}

/// Deletes tiles that are not listed.
void delete_other_tiles(const std::string& folder, const std::set<std::string>& kept) {
    for (const std::string& name : names_in(folder)) {
        std::error_code error;
        if (is_tile_name(name) && !kept.contains(name)) {
            std::filesystem::remove(path_of(folder, name), error);
        }
    }
}

std::set<std::string> tile_names(const WorldIndexView& index) {
    std::set<std::string> names;
    for (const std::string_view name : split_names(index.tile_names)) names.emplace(name);
    return names;
}

/// Writes the files of a new world beside those of the one that is there.
class WorldWriter {
  public:
    WorldWriter(const std::string& folder, WorldCutter cutter)
        : folder_(folder), cutter_(std::move(cutter)), index_(cutter_.index()) {}

    Status write(const WorldProgress& progress) {
        for (uint32_t tile = 0; tile < cutter_.tile_count(); ++tile) {
            if (auto status = write_tile(tile); !status) return status;
            if (progress && !progress(tile + 1, cutter_.tile_count())) {
                return Error{ErrorCode::Cancelled, "cancelled"};
            }
        }
        if (auto status = verify(index_.view()); !status) return status;
        return write_file(path_of(folder_, kWorldIndexName), world_index_bytes(index_.view()));
    }

    [[nodiscard]] const WorldIndex& index() const { return index_; }

  private:
    Status write_tile(uint32_t tile) {
        const CutTile cut = cutter_.cut(tile);
        if (auto status = verify(cut.volume.view()); !status) {
            return status.error().in(str_cat("tile ", tile));
        }
        const ExtraSection extra[] = {
            {kWorldCellsSection, std::as_bytes(std::span(cut.cells)), sizeof(uint32_t)},
            {kWorldProbesSection, std::as_bytes(std::span(cut.probes)), sizeof(uint32_t)}};
        const auto bytes = probe_file_bytes(cut.volume.view(), extra);
        const uint64_t sum = detail::checksum(bytes);
        const std::string name = str_cat(kTilePrefix, tile, "-", hex(sum), kTileSuffix);
        index_.tiles[tile] = cut.entry;
        index_.tiles[tile].file_size = bytes.size();
        index_.tile_names += name + "\n";
        return write_file(path_of(folder_, name), bytes);
    }

    std::string folder_;
    WorldCutter cutter_;
    WorldIndex index_;
};

}  // namespace

double tile_side_for(const ProbeVolumeView& volume, uint64_t probes_a_tile) {
    auto box = Box<glm::dvec3>::empty();
    for (const glm::vec3& p : volume.positions) box = union_of(box, glm::dvec3(p));
    const glm::dvec3 size = box.size();
    const double wanted = std::max(
        1.0, static_cast<double>(volume.probe_count()) / static_cast<double>(probes_a_tile));
    double small = 0.0;
    double large = std::max({size.x, size.y, size.z, 1e-6});
    for (int i = 0; i < 60; ++i) {  // bisection
        const double middle = 0.5 * (small + large);
        double count = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            count *= std::max(1.0, std::ceil(size[axis] / middle));
        }
        (count > wanted ? small : large) = middle;
    }
    return large;
}

Result<WorldSummary> write_world(const std::string& folder, const ProbeVolumeView& volume,
                                 const WorldSettings& settings, const WorldProgress& progress) {
    auto cutter = WorldCutter::make(volume, settings);
    if (!cutter) return cutter.error();
    if (auto status = prepare_folder(folder); !status) return status.error();
    std::set<std::string> old_names;
    if (const auto old = read_world_index(path_of(folder, kWorldIndexName))) {
        old_names = tile_names(old->view());
    }
    WorldWriter writer(folder, std::move(*cutter));
    if (auto status = writer.write(progress); !status) {
        if (!old_names.empty()) delete_other_tiles(folder, old_names);
        return status.error();
    }
    delete_other_tiles(folder, tile_names(writer.index().view()));
    return summary_of(writer.index().view());
}

WorldSummary summary_of(const WorldIndexView& index) {
    WorldSummary summary;
    summary.info = index.info;
    summary.tile_count = static_cast<uint32_t>(index.tiles.size());
    for (const WorldTile& tile : index.tiles) {
        summary.probe_count += tile.probe_count;
        summary.cell_count += tile.cell_count;
        summary.size += tile.file_size;
        summary.largest_tile_size = std::max(summary.largest_tile_size, tile.file_size);
    }
    summary.size += world_index_bytes(index).size();
    if (!index.tiles.empty()) summary.outside_tile_size = index.tiles.back().file_size;
    return summary;
}

}  // namespace tetralight
