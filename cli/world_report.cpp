// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/world_report.h>

#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/probes/world.h>

namespace tetralight::cli {
namespace {

std::string tiles_text(const WorldInfo& info) {
    const auto& [x, y, z] = info.tile_counts;
    return str_cat(counted(uint64_t{x} * y * z, "tile"), " (", x, " × ", y, " × ", z,
                   ") and one outside");
}

}  // namespace

void report_world(const std::string& folder, const WorldSummary& summary,
                  const CommonOptions& common) {
    const WorldInfo& info = summary.info;
    const double copies =
        static_cast<double>(summary.probe_count) / static_cast<double>(info.probe_count);
    const double largest =
        static_cast<double>(summary.largest_tile_size) / static_cast<double>(info.volume_size);
    common.print(
        {{"world", folder},
         {"tiles", summary.tile_count - 1},
         {"tile_counts", info.tile_counts},
         {"box",
          {to_json(info.world_origin + info.box_min), to_json(info.world_origin + info.box_max)}},
         {"probes", info.probe_count},
         {"cells", info.cell_count},
         {"held_probes", summary.probe_count},
         {"held_cells", summary.cell_count},
         {"volume_bytes", info.volume_size},
         {"bytes", summary.size},
         {"largest_tile_bytes", summary.largest_tile_size},
         {"outside_tile_bytes", summary.outside_tile_size}},
        str_cat(folder, ": ", tiles_text(info), "\n", counted(info.probe_count, "probe"),
                ", each in ", str_cat(static_cast<float>(std::round(copies * 100) / 100)),
                " tiles on average\n", magnitude(static_cast<double>(summary.size)),
                "B, the largest tile ", magnitude(static_cast<double>(summary.largest_tile_size)),
                "B, ", percent(largest), " of the volume (",
                magnitude(static_cast<double>(info.volume_size)), "B)"));
}

Status show_world(const std::string& folder, const CommonOptions& common) {
    auto world = World::open(folder);
    if (!world) return world.error();
    for (uint32_t tile = 0; tile < world->index().tiles.size(); ++tile) {
        const WorldMove move = world->open_only(std::span(&tile, 1));
        if (!move.failures.empty()) return move.failures[0];
        if (auto status = verify(*world->tiles()->find(tile)); !status) {
            return status.error().in(str_cat(folder, ": tile ", tile));
        }
    }
    report_world(folder, summary_of(world->index()), common);
    return Ok{};
}

}  // namespace tetralight::cli
