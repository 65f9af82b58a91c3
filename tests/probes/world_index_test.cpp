// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world_index.h>

#include <gtest/gtest.h>

#include <limits>

#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// Two tiles along x, three along z, and the one outside; the box is 20 × 5 × 30 m.
WorldIndex small_index() {
    WorldIndex index;
    index.info.world_origin = {100, 0, 0};
    index.info.box_max = {20, 5, 30};
    index.info.tile_counts = {2, 1, 3};
    index.info.extent = 40.0f;
    index.tiles.resize(7);
    index.borders = {10.0, 10.0, 20.0};
    for (int tile = 0; tile < 7; ++tile) index.tile_names += "tile-" + std::to_string(tile) + "\n";
    return index;
}

uint32_t tile_at(const WorldIndex& index, float x, float y, float z) {
    return find_place(index.view(), {x, y, z}).tile;
}

TEST(WorldIndex, GivesEachPositionToOneTile) {
    const WorldIndex index = small_index();
    EXPECT_EQ(tile_at(index, 101, 1, 1), 0u);
    EXPECT_EQ(tile_at(index, 111, 1, 1), 1u);
    EXPECT_EQ(tile_at(index, 101, 1, 15), 2u);
    EXPECT_EQ(tile_at(index, 111, 1, 25), 5u);
    EXPECT_EQ(tile_at(index, 110, 1, 20), 5u) << "borders belong to the tile above";
    EXPECT_EQ(tile_at(index, 100, 0, 0), 0u);
    EXPECT_EQ(tile_at(index, 120, 5, 30), 5u) << "the box is closed";
    EXPECT_EQ(tile_at(index, 99.99f, 1, 1), 6u);
    EXPECT_EQ(tile_at(index, 101, 5.01f, 1), 6u);
    EXPECT_EQ(tile_at(index, std::numeric_limits<float>::quiet_NaN(), 1, 1), kNoIndex);
}

TEST(WorldIndex, KnowsBoxesAndDistances) {
    const WorldIndex index = small_index();
    const Box<glm::dvec3> box = tile_box(index.view(), 3);
    EXPECT_EQ(box.min, glm::dvec3(10, 0, 10));
    EXPECT_EQ(box.max, glm::dvec3(20, 5, 20));
    EXPECT_EQ(distance_to_tile(index.view(), 3, {115, 2, 15}), 0.0);
    EXPECT_EQ(distance_to_tile(index.view(), 3, {107, 2, 6}), 5.0);  // 3 and 4 m away
    EXPECT_EQ(distance_to_tile(index.view(), 6, {115, 2, 15}), 2.0) << "to y = 0";
    EXPECT_EQ(distance_to_tile(index.view(), 6, {115, 9, 15}), 0.0);
}

TEST(WorldIndex, IsReadAsItWasWritten) {
    const TempFolder folder;
    const WorldIndex index = small_index();
    const auto read =
        read_world_index(folder.write("world.index", world_index_bytes(index.view())));
    ASSERT_TRUE(read) << error_text(read.error().message);
    EXPECT_EQ(*read, index);
}

TEST(WorldIndex, RefusesEveryChangedByteAndEveryTruncation) {
    const TempFolder folder;
    const auto bytes = world_index_bytes(small_index().view());
    for (size_t i = 0; i < bytes.size(); ++i) {
        auto changed = bytes;
        changed[i] ^= std::byte{1};
        ASSERT_FALSE(read_world_index(folder.write("changed", changed))) << "byte " << i;
        const auto cut = std::span(bytes).first(i);
        ASSERT_FALSE(read_world_index(folder.write("cut", cut))) << i << " bytes";
    }
    EXPECT_EQ(read_world_index(folder.path("nothing")).error().code, ErrorCode::NotFound);
}

TEST(WorldIndex, RefusesWhatDoesNotAgree) {
    const auto field_of = [](auto change) {
        WorldIndex index = small_index();
        change(index);
        const Status status = verify(index.view());
        return status ? std::string("nothing") : status.error().field;
    };
    EXPECT_EQ(field_of([](WorldIndex&) {}), "nothing");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.tiles.pop_back(); }), "tiles");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.info.tile_counts[1] = 0; }), "info");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.info.tile_counts[1] = 0xffffffffu; }), "info");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.borders.pop_back(); }), "borders");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.borders[2] = 5.0; }), "borders");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.borders[0] = 25.0; }), "borders");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.info.extent = -1.0f; }), "info");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.info.seed_grid.size[2] = 0; }), "info");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.outside_voxels = {3, 2}; }), "outside_voxels");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.tile_names += "more\n"; }), "tile_names");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.tile_names[0] = '/'; }), "tile_names[0]");
    EXPECT_EQ(field_of([](WorldIndex& i) { i.tile_names[0] = '.'; }), "tile_names[0]");
}

}  // namespace
}  // namespace tetralight
