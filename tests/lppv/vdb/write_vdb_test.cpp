// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/vdb/write_vdb.h>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include "tests/lppv/lppv_fixture.h"
#include "tests/lppv/vdb/read_vdb.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// A turned, mirrored grid that is no multiple of a block, with everything that a file can hold.
Lppv make_test_lppv(glm::uvec3 resolution = {11, 3, 9}) {
    ProbeVolume volume = test::make_random_volume(test::random_positions(200, 3), 4);
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
    const LppvGrid grid = test::grid_in_box(resolution, {1.5, -1.0, 0.5}, 30.0);
    std::vector<float> validity(grid.point_count(), 1.0f);
    validity.back() = 0.25f;
    return *make_lppv(volume.view(), grid, {.validity = validity});
}

void expect_values(const Lppv& lppv, const test::ReadGrids& grids, float tolerance) {
    for (const auto& [name, grid] : grids) {
        ASSERT_EQ(grid.active.size(), lppv.grid.point_count()) << name;
        for (const test::ReadVoxel& voxel : grid.active) {
            const size_t i = lppv.grid.point_index(glm::uvec3(voxel.index));
            glm::vec3 expected(0.0f);
            if (name == "validity") expected = glm::vec3(lppv.validity[i]);
            if (name.starts_with("sh")) {
                expected = lppv.irradiance[i].coefficients[static_cast<size_t>(name[2] - '0')];
            }
            if (name.starts_with("occlusion")) {
                expected = glm::vec3(lppv.occlusion[i][name[9] - '0']);
            }
            ASSERT_LE(glm::distance(voxel.value, expected),
                      tolerance * (1.0f + glm::length(expected)))
                << name;
        }
    }
}

void expect_places(const Lppv& lppv, const test::ReadGrids& grids) {
    for (const auto& [name, grid] : grids) {
        EXPECT_LE(glm::distance(grid.origin, lppv.grid.world_position({0, 0, 0})), 1e-6) << name;
        EXPECT_LE(glm::distance(grid.place_of_123, lppv.grid.world_position({1, 2, 3})), 1e-6);
    }
}

TEST(WriteVdb, ReadsBackByOpenVdb) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv();
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Float));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
    EXPECT_EQ(grids.size(), 14u);  // nine vectors, validity, four channels of occlusion
    expect_values(lppv, grids, 0.0f);
    expect_places(lppv, grids);
    for (const char* key : {"sh:basis", "sh:quantity", "sh:axes"}) {
        EXPECT_FALSE(meta[key].empty()) << key;
        EXPECT_EQ(grids.at("sh3").metadata.at(key), meta[key]);
    }
    EXPECT_TRUE(grids.at("sh8").is_vector);
    EXPECT_FALSE(grids.at("sh8").is_saved_as_half);
}

TEST(WriteVdb, HalvesAreSmallerAndNear) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv({33, 20, 17});
    ASSERT_TRUE(write_vdb(folder.path("float.vdb"), lppv, VdbPrecision::Float));
    ASSERT_TRUE(write_vdb(folder.path("half.vdb"), lppv, VdbPrecision::Half));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("half.vdb"), meta);
    EXPECT_TRUE(grids.at("sh0").is_saved_as_half);
    expect_values(lppv, grids, 1e-3f);
    EXPECT_LT(std::filesystem::file_size(folder.path("half.vdb")),
              0.7 * static_cast<double>(std::filesystem::file_size(folder.path("float.vdb"))));
}

TEST(WriteVdb, HalvesSaturate) {
    const TempFolder folder;
    Lppv lppv = make_test_lppv({2, 1, 1});
    lppv.irradiance[0].coefficients[0] = {1e6f, -1e6f, 1.0f};
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Half));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
    EXPECT_EQ(grids.at("sh0").active[0].value, glm::vec3(65504.0f, -65504.0f, 1.0f));
}

TEST(WriteVdb, PointsAtOnePlaceAreOneVoxel) {
    const TempFolder folder;
    const ProbeVolume volume = test::make_cube_volume();
    const LppvGrid grid = test::grid_in_box({3, 2, 3}, {2.0, 0.0, 2.0}, 0.0);
    const Lppv lppv = *make_lppv(volume.view(), grid, {});
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Float));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
    ASSERT_EQ(grids.at("sh0").active.size(), 9u);
    for (const test::ReadVoxel& voxel : grids.at("sh0").active) {
        EXPECT_EQ(voxel.index.y, 0);
        const size_t i = grid.point_index(glm::uvec3(voxel.index));
        EXPECT_EQ(voxel.value, lppv.irradiance[i].coefficients[0]);
    }
}

TEST(WriteVdb, BlocksOfOneValueAreTiles) {
    const TempFolder folder;
    const ProbeVolume volume = test::make_random_volume(test::random_positions(200, 3), 4);
    const LppvGrid grid = test::grid_in_box({17, 16, 9}, glm::dvec3(1.5), 30.0);
    const Lppv lppv = *make_lppv(volume.view(), grid, {.quality = LppvQuality::Normal});
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Float));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
    // Whole blocks of 8 x 8 x 8 points.
    for (const char* name : {"sh4", "sh8", "validity"}) {
        EXPECT_EQ(grids.at(name).tile_count, 2u * 2u * 1u) << name;
        EXPECT_EQ(grids.at(name).active.size(), grid.point_count()) << name;
    }
    EXPECT_EQ(grids.at("sh3").tile_count, 0u);
    EXPECT_EQ(grids.at("sh4").active.back().value, lppv.irradiance[0].coefficients[4]);
    ASSERT_TRUE(write_nvdb(folder.path("a.nvdb"), lppv));
    EXPECT_EQ(test::read_nvdb(folder.path("a.nvdb")).at("sh4").active.size(), grid.point_count());
}

TEST(WriteVdb, GivesTheSameBytesOnAnyThreads) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv();
    for (const uint32_t threads : {1u, 2u}) {
        const std::string name = folder.path(str_cat(threads));
        ASSERT_TRUE(write_vdb(name + ".vdb", lppv, VdbPrecision::Half, threads));
        ASSERT_TRUE(write_nvdb(name + ".nvdb", lppv, threads));
    }
    EXPECT_EQ(*read_file(folder.path("1.vdb")), *read_file(folder.path("2.vdb")));
    EXPECT_EQ(*read_file(folder.path("1.nvdb")), *read_file(folder.path("2.nvdb")));
}

TEST(WriteVdb, IsListedByVdbPrint) {
    const TempFolder folder;
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), make_test_lppv(), VdbPrecision::Half));
    const std::string command = std::string(TETRALIGHT_VDB_PRINT) + " -l " + folder.path("a.vdb") +
                                " > " + folder.path("list");
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto bytes = read_file(folder.path("list"));
    const std::string list(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (const char* words : {"Name: sh0", "Name: sh8", "Name: validity", "Name: occlusion3",
                              "vec3s", "sh:basis", "11 x 3 x 9"}) {
        EXPECT_NE(list.find(words), std::string::npos) << words << " in\n" << list;
    }
}

TEST(WriteVdb, ReadsBackByNanoVdb) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv();
    ASSERT_TRUE(write_nvdb(folder.path("a.nvdb"), lppv));
    const auto grids = test::read_nvdb(folder.path("a.nvdb"));
    EXPECT_EQ(grids.size(), 14u);
    EXPECT_TRUE(grids.at("sh0").is_vector);
    expect_values(lppv, grids, 0.0f);
    expect_places(lppv, grids);
}

TEST(WriteVdb, VoxelsOfFlatGridsHaveASize) {
    const TempFolder folder;
    for (const glm::uvec3 resolution : {glm::uvec3(5, 1, 1), glm::uvec3(1, 1, 1)}) {
        const Lppv lppv = make_test_lppv(resolution);
        ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Float));
        std::map<std::string, std::string> meta;
        const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
        expect_values(lppv, grids, 0.0f);
        EXPECT_GT(glm::distance(grids.at("sh0").origin, grids.at("sh0").place_of_123), 0.1);
    }
}

TEST(WriteVdb, SparseFilesHoldTheirBlocksOnly) {
    const TempFolder folder;
    const ProbeVolume volume = test::make_cube_volume();
    SparseBlocks blocks(0.25);
    ASSERT_TRUE(blocks.add_box(glm::dvec3(-0.5), glm::dvec3(0.5)));
    ASSERT_TRUE(blocks.add_box({5000, 3, 3}, {5000, 3, 3}));
    const SparseLppv lppv = make_sparse_lppv(volume.view(), blocks, [](size_t count, auto&& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    });
    ASSERT_TRUE(write_vdb(folder.path("a.vdb"), lppv, VdbPrecision::Float));
    std::map<std::string, std::string> meta;
    const auto grids = test::read_vdb(folder.path("a.vdb"), meta);
    ASSERT_EQ(grids.at("sh2").active.size(), 9u * 512u);
    for (const test::ReadVoxel& voxel : grids.at("sh2").active) {
        const glm::dvec3 p = 0.25 * glm::dvec3(voxel.index);
        if (p.x > 4.0) continue;
        EXPECT_LE(glm::distance(voxel.value, test::linear_light(p).coefficients[2]), 4e-5f);
    }
    EXPECT_LE(glm::distance(grids.at("sh2").place_of_123, glm::dvec3(0.25, 0.5, 0.75)), 1e-12);
    ASSERT_TRUE(write_nvdb(folder.path("a.nvdb"), lppv));
}

TEST(WriteVdb, AFullDiskLeavesTheOldFile) {
    const TempFolder folder;
    const std::string path = folder.write("a.vdb", "old");
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit small{4096, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto vdb = write_vdb(path, make_test_lppv(), VdbPrecision::Float);
    const auto nvdb = write_nvdb(path, make_test_lppv());
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(vdb);
    ASSERT_FALSE(nvdb);
    EXPECT_NE(error_text(vdb.error()).find("a.vdb: cannot write"), std::string::npos);
    EXPECT_EQ(read_file(path)->size(), 3u);
    const auto left = std::filesystem::directory_iterator(folder.path(""));
    EXPECT_EQ(std::distance(begin(left), end(left)), 1);
}

}  // namespace
}  // namespace tetralight
