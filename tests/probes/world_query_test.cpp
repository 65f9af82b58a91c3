// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world_query.h>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <limits>

#include "tests/support/cut_worlds.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

class WorldQueryTest : public testing::Test {
  protected:
    ProbeVolume volume = test::make_lit_volume(test::random_positions(500, 1));
    TempFolder folder;

    void SetUp() override {
        volume.info.ambient.coefficients[0] = glm::vec3(0.25f);
        test::write_world(folder, volume.view(), {.tile_size = glm::dvec3(1.0)});
    }
};

TEST_F(WorldQueryTest, SaysWhichPositionsHaveNoAnswer) {
    auto world = World::open(folder.path(""));
    ASSERT_TRUE(world);
    world->move_to({-0.5, -0.5, -0.5}, 0.1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec3> positions{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, {nan, 0, 0}};
    std::vector<WorldState> states(3);
    std::vector<IrradianceSh> light(3);
    const auto report = interpolate(
        *world->tiles(), {.positions = positions, .irradiance = light, .states = states});
    ASSERT_TRUE(report);
    EXPECT_EQ(*report, (WorldReport{1, 1, 0}));
    EXPECT_EQ(states,
              (std::vector{WorldState::Answered, WorldState::Closed, WorldState::NotFinite}));
    EXPECT_EQ(light[1], volume.info.ambient);
    EXPECT_EQ(light[2], volume.info.ambient);
    EXPECT_EQ(light[0], interpolate(volume.view(), locate(volume.view(), positions[0])).irradiance);
}

TEST_F(WorldQueryTest, PoliciesOutsideNeedTheTileOutside) {
    auto world = World::open(folder.path(""));
    ASSERT_TRUE(world);
    // In the box of the probes and outside of their hull.
    glm::vec3 corner(0.0f);
    for (const glm::vec3& p : volume.positions) corner = glm::max(corner, p);
    corner += glm::vec3(volume.info.world_origin) - 1e-3f;
    ASSERT_GE(locate(volume.view(), corner).cell, volume.info.inner_cell_count);
    const std::vector<glm::vec3> positions{corner};
    world->open_only(tiles_of(world->index(), positions));
    const OutsideHull clamp{OutsidePolicy::Clamp, 1.0f};
    const auto closed = interpolate(*world->tiles(), {.positions = positions, .outside = clamp});
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->closed_count, 1u);
    test::expect_same_answers(volume.view(), *world->tiles(), positions);
    test::expect_same_answers(volume.view(), *test::open_all(folder), positions, clamp);
}

TEST_F(WorldQueryTest, RefusesOutputsThatAreTooShort) {
    const auto tiles = test::open_all(folder);
    const std::vector<glm::vec3> positions(3);
    std::vector<WorldState> states(2);
    const auto report = interpolate(*tiles, {.positions = positions, .states = states});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(report.error().field, "states");
}

TEST_F(WorldQueryTest, ListsTheTilesOfPositions) {
    auto world = World::open(folder.path(""));
    ASSERT_TRUE(world);
    const auto outside = static_cast<uint32_t>(world->index().tiles.size() - 1);
    const std::vector<glm::vec3> positions{{5, 0, 0}, {-0.5f, -0.5f, -0.5f}, {-0.4f, -0.5f, -0.5f}};
    EXPECT_EQ(tiles_of(world->index(), positions), (std::vector<uint32_t>{0, outside}));
}

}  // namespace
}  // namespace tetralight
