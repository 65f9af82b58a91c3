// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/cut_world.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/world_query.h>
#include "tests/support/temp_folder.h"

namespace tetralight::test {

/// Writes all tiles of a volume and the index to a folder.
inline void write_world(const TempFolder& folder, const ProbeVolumeView& volume,
                        const WorldSettings& settings) {
    auto cutter = WorldCutter::make(volume, settings);
    ASSERT_TRUE(cutter) << error_text(cutter.error().message);
    WorldIndex index = cutter->index();
    for (uint32_t tile = 0; tile < cutter->tile_count(); ++tile) {
        const CutTile cut = cutter->cut(tile);
        const Status is_right = verify(cut.volume.view());
        ASSERT_TRUE(is_right) << "tile " << tile << ": " << error_text(is_right.error().message);
        const ExtraSection extra[] = {
            {kWorldCellsSection, std::as_bytes(std::span(cut.cells)), sizeof(uint32_t)},
            {kWorldProbesSection, std::as_bytes(std::span(cut.probes)), sizeof(uint32_t)}};
        const auto bytes = probe_file_bytes(cut.volume.view(), extra);
        const std::string name = str_cat("tile-", tile, ".probes");
        folder.write(name, bytes);
        index.tiles[tile] = cut.entry;
        index.tiles[tile].file_size = bytes.size();
        index.tile_names += name + "\n";
    }
    folder.write(std::string(kWorldIndexName), world_index_bytes(index.view()));
}

/// All tiles of a world, open.
inline std::shared_ptr<const WorldTiles> open_all(const TempFolder& folder) {
    auto world = World::open(folder.path(""));
    EXPECT_TRUE(world) << error_text(world.error().message);
    if (!world) return {};
    std::vector<uint32_t> all;
    for (uint32_t tile = 0; tile < world->index().tiles.size(); ++tile) all.push_back(tile);
    const WorldMove move = world->open_only(all);
    for (const Error& failure : move.failures) ADD_FAILURE() << error_text(failure.message);
    return world->tiles();
}

/// Expects the answers of a world to be those of the volume that was cut: cell, weights and light.
inline void expect_same_answers(const ProbeVolumeView& volume, const WorldTiles& tiles,
                                const std::vector<glm::vec3>& positions,
                                const OutsideHull& outside = {}, const Receiver& receiver = {}) {
    const size_t count = positions.size();
    std::vector<IrradianceSh> light(count);
    std::vector<glm::vec4> occlusion(count);
    std::vector<WorldLocation> locations(count);
    const auto report = interpolate(tiles, {.positions = positions,
                                            .irradiance = light,
                                            .occlusion = occlusion,
                                            .locations = locations,
                                            .outside = outside,
                                            .receiver = receiver});
    ASSERT_TRUE(report) << error_text(report.error().message);
    EXPECT_EQ(report->lost_count, 0u);
    EXPECT_EQ(report->closed_count, 0u);
    for (size_t i = 0; i < count; ++i) {
        const CellLocation expected = locate(volume, positions[i], kNoIndex, outside);
        const InterpolatedProbe probe = interpolate(volume, expected, receiver);
        CellLocation found = locations[i].location;
        ASSERT_NE(locations[i].tile, kNoIndex);
        const auto cells = tiles.volume_cells(locations[i].tile);
        ASSERT_LT(found.cell, cells.size());
        found.cell = cells[found.cell];
        ASSERT_EQ(found, expected)
            << "position " << i << ": " << positions[i].x << " " << positions[i].y << " "
            << positions[i].z << " in tile " << locations[i].tile << ": cell " << found.cell
            << " instead of " << expected.cell;
        ASSERT_EQ(light[i], probe.irradiance) << "position " << i;
        ASSERT_EQ(occlusion[i], probe.occlusion) << "position " << i;
    }
}

inline std::vector<glm::vec3> as_floats(const std::vector<glm::dvec3>& positions) {
    std::vector<glm::vec3> floats;
    for (const glm::dvec3& p : positions) floats.emplace_back(p);
    return floats;
}

/// Positions where cells meet: at probes, and at the middles of edges and faces.
inline std::vector<glm::vec3> meeting_positions(const ProbeVolume& volume, size_t stride = 1) {
    std::vector<glm::dvec3> positions;
    for (size_t cell = 0; cell < volume.info.inner_cell_count; cell += stride) {
        std::array<glm::dvec3, 4> corners;
        for (size_t i = 0; i < 4; ++i) {
            corners[i] = glm::dvec3(volume.positions[volume.cells[cell].vertices[i]]) +
                         volume.info.world_origin;
        }
        positions.push_back(corners[0]);
        positions.push_back(0.5 * (corners[0] + corners[1]));
        positions.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
        positions.push_back(0.25 * corners[0] + 0.25 * corners[1] + 0.5 * corners[2]);
    }
    return as_floats(positions);
}

}  // namespace tetralight::test
