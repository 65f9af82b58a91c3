// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/walls_metadata.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

const WallsMetadata kWalls{
    .edge_count = 100,
    .blocked_edge_count = 20,
    .marked_cell_count = 30,
    .unclear_cell_count = 3,
    .left_out_count = 1,
    .unseen = {.place_count = 4096, .unseen_count = 7, .positions = {{1.5, -2.001, 1e6}}}};

TEST(WallsMetadata, IsReadAsItWasWritten) {
    const std::string metadata = add_walls(R"({"samples":16})", kWalls);
    EXPECT_EQ(metadata.find(R"({"samples":16,"walls":{)"), 0u) << metadata;
    EXPECT_EQ(read_walls(metadata), kWalls);
    EXPECT_EQ(read_walls(add_walls(metadata, {})), WallsMetadata{});
}

TEST(WallsMetadata, IsNoneInVolumesThatHaveNoneOrOneOfAnotherForm) {
    for (const char* metadata :
         {"", "{}", "[", R"({"walls":1})", R"({"walls":{"unclear_cells":3}})",
          R"({"walls":{"unclear_cells":-3,"left_out_probes":0,"free_places":0,"unseen_places":0,
              "unseen":[]}})",
          R"({"walls":{"unclear_cells":3,"left_out_probes":0,"free_places":0,"unseen_places":0,
              "unseen":[[1,2]]}})"}) {
        EXPECT_FALSE(read_walls(metadata)) << metadata;
    }
}

}  // namespace
}  // namespace tetralight
