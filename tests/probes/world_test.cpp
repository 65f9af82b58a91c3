// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world.h>

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "tests/support/cut_worlds.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

class WorldTest : public testing::Test {
  protected:
    ProbeVolume volume = test::make_lit_volume(test::random_positions(4000, 1, 8.0));
    TempFolder folder;

    void SetUp() override {
        test::write_world(folder, volume.view(), {.tile_size = glm::dvec3(4.0)});
    }

    [[nodiscard]] World open(const WorldOptions& options = {}) const {
        auto world = World::open(folder.path(""), options);
        EXPECT_TRUE(world) << error_text(world.error().message);
        return std::move(*world);
    }
};

TEST_F(WorldTest, OpensTilesWithinTheRadiusAndClosesFarOnes) {
    World world = open({.hysteresis = 1.0});
    EXPECT_EQ(world.tiles()->open_count(), 0u);
    const glm::dvec3 corner(-7, -7, -7);
    // The tiles reach to -4 and on: those beside it are 3 m away.
    EXPECT_EQ(world.move_to(corner, 0.5).opened_count, 1u);
    EXPECT_EQ(world.tiles()->open_count(), 1u);
    const uint32_t tile = find_place(world.index(), glm::vec3(corner)).tile;
    EXPECT_TRUE(world.tiles()->is_open(tile));

    EXPECT_EQ(world.move_to(corner, 0.5).opened_count, 0u) << "it is open already";
    const glm::dvec3 beside(-2.7, -7, -7);  // 1.3 m beyond: within radius + hysteresis
    EXPECT_EQ(world.move_to(beside, 0.5).closed_count, 0u);
    EXPECT_TRUE(world.tiles()->is_open(tile));
    const WorldMove away = world.move_to({7, 7, 7}, 0.5);
    EXPECT_EQ(away.closed_count, 2u);
    EXPECT_FALSE(world.tiles()->is_open(tile));
}

TEST_F(WorldTest, OpensTheTileOutsideNearTheBorder) {
    World world = open();
    const auto outside = static_cast<uint32_t>(world.index().tiles.size() - 1);
    world.move_to({0, 0, 0}, 1.0);
    EXPECT_FALSE(world.tiles()->is_open(outside));
    world.move_to({0, 7.5, 0}, 1.0);
    EXPECT_TRUE(world.tiles()->is_open(outside));
}

TEST_F(WorldTest, AFlightStaysWithinItsMemoryWithTheAnswersOfTheVolume) {
    const World closed = open();
    uint64_t largest = 0;
    for (const WorldTile& tile : closed.index().tiles) largest = std::max(largest, tile.file_size);
    World world = open({.hysteresis = 1.0, .max_size = 9 * largest});
    const auto around = test::random_positions(200, 2, 0.8);
    for (int step = 0; step <= 100; ++step) {
        const double t = -6.0 + 0.12 * step;
        const glm::dvec3 camera(t, 0.5 * t, 3.0 - 0.3 * t);
        const WorldMove move = world.move_to(camera, 1.5);
        ASSERT_TRUE(move.failures.empty());
        ASSERT_EQ(move.left_out_count, 0u);
        ASSERT_LE(world.tiles()->open_size(), 9 * largest);
        std::vector<glm::vec3> positions;
        for (const glm::dvec3& p : around) positions.emplace_back(camera + p);
        test::expect_same_answers(volume.view(), *world.tiles(), positions);
    }
}

TEST_F(WorldTest, LeavesOutTilesBeyondTheLargestSize) {
    World world = open({.max_size = 1});
    const WorldMove move = world.move_to({0, 0, 0}, 1.0);
    EXPECT_EQ(move.opened_count, 0u);
    EXPECT_EQ(move.left_out_count, 8u) << "tiles adjoin at the middle";
    World roomy = open();
    EXPECT_EQ(roomy.move_to({0, 0, 0}, 1.0).left_out_count, 0u);
    EXPECT_EQ(roomy.tiles()->open_count(), 8u);
}

TEST_F(WorldTest, NamesMissingAndForeignTilesAndOpensTheOthers) {
    World world = open();
    const uint32_t missing = find_place(world.index(), {-7, -7, -7}).tile;
    const uint32_t foreign = find_place(world.index(), {-3, -7, -7}).tile;
    const auto path = [&](uint32_t tile) { return folder.path(str_cat("tile-", tile, ".probes")); };
    std::filesystem::remove(path(missing));
    std::filesystem::copy_file(path(foreign + 1), path(foreign),
                               std::filesystem::copy_options::overwrite_existing);
    const WorldMove move = world.move_to({0, 0, 0}, 100.0);
    ASSERT_EQ(move.failures.size(), 2u);
    EXPECT_EQ(move.opened_count + 2, world.index().tiles.size());
    EXPECT_FALSE(world.tiles()->is_open(missing));
    EXPECT_FALSE(world.tiles()->is_open(foreign));
    for (const Error& failure : move.failures) {
        const bool is_missing = failure.code == ErrorCode::NotFound;
        EXPECT_TRUE(is_missing || failure.code == ErrorCode::Corrupt);
        const uint32_t tile = is_missing ? missing : foreign;
        EXPECT_NE(error_text(failure.message).find(path(tile)), std::string::npos);
    }
}

TEST_F(WorldTest, QueriesGoOnWhileTilesOpenAndClose) {
    World world = open({.hysteresis = 0.0});
    world.move_to({-6, -6, -6}, 1.0);
    const auto before = world.tiles();
    std::atomic<bool> is_done = false;
    std::jthread camera([&] {
        for (int step = 0; step < 200; ++step) {
            world.move_to({step % 2 == 0 ? 6 : -6, -6, -6}, 1.0);
            world.release_pages();
        }
        is_done = true;
    });
    const std::vector<glm::vec3> positions(100, glm::vec3(-6));
    do {
        test::expect_same_answers(volume.view(), *before, positions);
        std::vector<WorldState> states(positions.size());
        const auto report = interpolate(*world.tiles(), {.positions = positions, .states = states});
        ASSERT_TRUE(report);
        ASSERT_TRUE(report->closed_count == 0 || report->closed_count == positions.size());
    } while (!is_done);
}

TEST_F(WorldTest, GivesBackMemoryAndReadsAgain) {
    World world = open();
    world.move_to({0, 0, 0}, 100.0);
    std::vector<glm::vec3> positions = test::as_floats(test::random_positions(2000, 3, 7.9));
    test::expect_same_answers(volume.view(), *world.tiles(), positions);
    world.release_pages();
    test::expect_same_answers(volume.view(), *world.tiles(), positions);
}

TEST_F(WorldTest, IsFoundByItsIndex) {
    EXPECT_TRUE(is_world(folder.path("")));
    EXPECT_FALSE(is_world(folder.path("nowhere")));
    EXPECT_EQ(World::open(folder.path("nowhere")).error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace tetralight
