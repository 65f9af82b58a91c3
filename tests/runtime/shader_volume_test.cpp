// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_volume.h>

#include <gtest/gtest.h>

#include <cstring>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/seed_grid.h>
#include <tetralight/runtime/shader_query.h>
#include "tests/support/property_volume.h"

namespace tetralight {
namespace {

ProbeVolume make_volume(size_t count) {
    return test::make_random_volume(test::random_positions(count, 5, 10.0), 6);
}

TEST(ShaderVolume, HoldsProbesAndCellsInTheirOrder) {
    const ProbeVolume volume = make_volume(200);
    const ShaderVolume shader = make_shader_volume(volume.view());
    ASSERT_EQ(shader.positions.size(), volume.positions.size());
    ASSERT_EQ(shader.cells.size(), volume.cells.size());
    ASSERT_EQ(shader.hull_rays.size(), 3 * volume.hull_rays.size());
    EXPECT_EQ(shader.constants.counts, glm::uvec4(volume.positions.size(), volume.cells.size(),
                                                  volume.info.inner_cell_count, 4u));
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        EXPECT_EQ(glm::vec3(shader.positions[i]), volume.positions[i]);
        EXPECT_EQ(shader.light[i].sh, pack_sh(volume.irradiance[i]));
        EXPECT_EQ(shader.light[i].occlusion, glm::vec4(1.0f));
    }
    for (size_t i = 0; i < volume.cells.size(); ++i) {
        EXPECT_EQ(shader.cells[i].vertices.x, volume.cells[i].vertices[0]);
        EXPECT_EQ(shader.cells[i].neighbors.w, volume.cells[i].neighbors[3]);
    }
}

TEST(ShaderVolume, LightIsWhatQueriesRead) {
    ProbeVolume volume = make_volume(50);
    volume.occlusion.assign(50, glm::vec4(0.25f));
    make_compact_probes(volume);
    const ShaderVolume shader = make_shader_volume(volume.view());
    EXPECT_EQ(shader.light[7].sh,
              pack_sh(compact_irradiance(volume.compact[7], volume.info.compact_scale)));
    EXPECT_EQ(shader.light[7].occlusion, glm::vec4(0.25f));
}

TEST(ShaderVolume, WithoutBakedLightEveryProbeIsAmbient) {
    ProbeVolume volume = make_volume(20);
    volume.irradiance.clear();
    volume.info.ambient.coefficients[0] = glm::vec3(3.0f);
    const ShaderVolume shader = make_shader_volume(volume.view());
    const PackedProbe probe = interpolate(shader, locate(shader, glm::vec3(0.0f)));
    EXPECT_NEAR(probe.sh.sha_r.w, pack_sh(volume.info.ambient).sha_r.w, 1e-6f);
}

TEST(ShaderVolume, SeedsAreTheSeedGridOfTheVolume) {
    const ProbeVolume volume = make_volume(5000);
    const ShaderVolume shader = make_shader_volume(volume.view());
    const SeedGridHeader header = seed_grid_header(volume.seed_grid, 0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto place = static_cast<size_t>(axis);
        EXPECT_EQ(shader.constants.seed_min[axis], header.min[place]);
        EXPECT_EQ(shader.constants.seed_scale[axis], header.scale[place]);
        EXPECT_EQ(shader.constants.seed_size[axis], header.size[place]);
    }
    ASSERT_EQ(shader.constants.seed_size.w, volume.seed_grid.size());
    ASSERT_EQ(shader.seeds.size(), (volume.seed_grid.size() + 3) / 4);
    EXPECT_EQ(std::memcmp(shader.seeds.data(), volume.seed_grid.data(),
                          volume.seed_grid.size() * sizeof(uint32_t)),
              0);
}

TEST(ShaderVolume, WithoutASeedGridSeedsAreCellsNearThePositions) {
    ProbeVolume volume = make_volume(5000);
    volume.seed_grid.clear();  // as in files of older versions
    make_seeds(volume);
    const ShaderVolume shader = make_shader_volume(volume.view());
    const glm::uvec4 size = shader.constants.seed_size;
    const size_t voxels = size_t{size.x} * size.y * size.z;
    EXPECT_GE(voxels, 5000u);
    EXPECT_LE(voxels, 20000u);
    ASSERT_EQ(size.w, kSeedGridHeaderWords + voxels);
    ASSERT_EQ(shader.seeds.size(), (size.w + 3) / 4);
    for (const glm::vec3& position : volume.positions) {
        EXPECT_LT(seed_cell(shader, position), volume.cells.size());
    }
}

TEST(ShaderVolume, WallsAreBlocksAndThenCodes) {
    ProbeVolume volume = make_volume(50);
    EXPECT_EQ(make_shader_volume(volume.view()).constants.walls, glm::uvec4(0));
    const auto block_count = static_cast<uint32_t>((volume.cells.size() + 31) / 32);
    volume.visibility_blocks.resize(block_count, {2, 0});
    volume.visibility_blocks[0] = {0, 5};
    volume.visibility_blocks[1] = {7, 11};
    volume.cell_visibility.resize(2);
    for (size_t i = 0; i < 12; ++i) volume.cell_visibility[1].codes[i] = static_cast<uint8_t>(i);
    volume.cell_visibility[1].splits = {0x34, 0x12};
    const ShaderVolume shader = make_shader_volume(volume.view());
    const uint32_t first = (block_count + 1) / 2;
    EXPECT_EQ(shader.constants.walls, glm::uvec4(block_count, first, 2, 0));
    ASSERT_EQ(shader.walls.size(), first + 2);
    EXPECT_EQ(shader.walls[0], glm::uvec4(0, 5, 7, 11));
    EXPECT_EQ(shader.walls[first + 1], glm::uvec4(0x03020100, 0x07060504, 0x0b0a0908, 0x1234));
}

TEST(ShaderVolume, NoProbesGiveTheAmbientLight) {
    ProbeVolume volume;
    volume.info.ambient.coefficients[0] = glm::vec3(2.0f);
    const ShaderVolume shader = make_shader_volume(volume.view());
    EXPECT_FALSE(shader.positions.empty() || shader.light.empty() || shader.cells.empty() ||
                 shader.hull_rays.empty() || shader.seeds.empty() || shader.walls.empty());
    const CellLocation location = locate(shader, glm::vec3(1.0f));
    EXPECT_EQ(location.cell, kNoIndex);
    EXPECT_EQ(location.ambient, 1.0f);
    EXPECT_EQ(interpolate(shader, location).sh, pack_sh(volume.info.ambient));
}

TEST(ShaderVolume, IndicesOfABrokenFileLeadNowhere) {
    ProbeVolume volume = make_volume(100);
    std::mt19937_64 engine(7);
    for (int i = 0; i < 200; ++i) {
        Cell& cell = volume.cells[engine() % volume.cells.size()];
        cell.vertices[engine() % 4] = static_cast<uint32_t>(engine());
        cell.neighbors[engine() % 4] = static_cast<uint32_t>(engine());
    }
    volume.hull_rays.resize(volume.hull_rays.size() / 2);
    const ShaderVolume shader = make_shader_volume(volume.view());
    for (const ShaderCell& cell : shader.cells) {
        for (int i = 0; i < 4; ++i) {
            EXPECT_LT(cell.vertices[i], volume.positions.size());
            EXPECT_TRUE(cell.neighbors[i] < volume.cells.size() || cell.neighbors[i] == kNoIndex);
        }
    }
    for (int i = 0; i < 1000; ++i) {
        const PackedProbe probe =
            interpolate(shader, locate(shader, 20.0f * test::random_direction(engine)));
        EXPECT_TRUE(std::isfinite(probe.sh.sha_r.w));
    }
}

}  // namespace
}  // namespace tetralight
