// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/lppv/lppv_grid.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tetralight {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const LppvPart kUnitCube{glm::dmat4(1.0), glm::dvec3(-0.5), glm::dvec3(0.5)};

glm::dmat4 placed(const glm::dvec3& position, double degrees, const glm::dvec3& scale) {
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), position),
                                          glm::radians(degrees), glm::dvec3(1, 2, 3) / sqrt(14.0));
    return glm::scale(turned, scale);
}

/// The grid of a cube that a transform places.
Result<LppvGrid> grid_of_cube(const glm::dmat4& world_from_object, const LppvSettings& settings) {
    const LppvPart part{world_from_object, kUnitCube.min, kUnitCube.max};
    return make_lppv_grid({world_from_object, std::span(&part, 1)}, settings);
}

std::string error_of(const LppvSettings& settings, const LppvPart& part = kUnitCube) {
    const auto grid = make_lppv_grid({glm::dmat4(1.0), std::span(&part, 1)}, settings);
    return grid ? "" : error_text(grid.error());
}

LppvSettings with_resolution(glm::uvec3 resolution) {
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = resolution;
    return settings;
}

void expect_at(const LppvGrid& grid, glm::uvec3 point, const glm::dvec3& expected) {
    EXPECT_LE(glm::distance(grid.world_position(point), expected), 1e-12);
}

TEST(LppvGrid, CornersTouchTheFacesOfTheBox) {
    const auto grid = grid_of_cube(glm::dmat4(1.0), with_resolution({3, 2, 5}));
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->point_count(), 30u);
    expect_at(*grid, {0, 0, 0}, glm::dvec3(-0.5));
    expect_at(*grid, {2, 1, 4}, glm::dvec3(0.5));
    expect_at(*grid, {1, 0, 1}, {0.0, -0.5, -0.25});
}

TEST(LppvGrid, CentersLieHalfASpacingInside) {
    LppvSettings settings = with_resolution({4, 2, 1});
    settings.placement = LppvPlacement::CellCenters;
    const auto grid = grid_of_cube(glm::dmat4(1.0), settings);
    ASSERT_TRUE(grid);
    expect_at(*grid, {0, 0, 0}, {-0.375, -0.25, 0.0});
    expect_at(*grid, {3, 1, 0}, {0.375, 0.25, 0.0});
}

TEST(LppvGrid, LocalBoxesTurnScaleAndMirrorWithTheObject) {
    for (const glm::dvec3 scale : {glm::dvec3(2, 3, 10), glm::dvec3(-2, 3, 0.5)}) {
        const glm::dmat4 world_from_object = placed({5, 6, 7}, 33.0, scale);
        const auto grid = grid_of_cube(world_from_object, with_resolution({2, 2, 2}));
        ASSERT_TRUE(grid);
        expect_at(*grid, {0, 0, 0}, glm::dvec3(world_from_object * glm::dvec4(-.5, -.5, -.5, 1)));
        expect_at(*grid, {1, 0, 1}, glm::dvec3(world_from_object * glm::dvec4(.5, -.5, .5, 1)));
        EXPECT_LE(glm::distance(grid->spacing(), glm::abs(scale)), 1e-12);
    }
}

TEST(LppvGrid, WorldBoxesHoldEveryCornerAlongTheAxes) {
    LppvSettings settings = with_resolution({2, 2, 2});
    settings.bounds = LppvBounds::AutomaticWorld;
    const glm::dmat4 quarter_turn =
        glm::scale(glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0, 1, 0)),
                   glm::dvec3(10, 2, 1));
    const auto grid = grid_of_cube(quarter_turn, settings);
    ASSERT_TRUE(grid);
    expect_at(*grid, {0, 0, 0}, {-0.5, -1.0, -5.0});
    expect_at(*grid, {1, 1, 1}, {0.5, 1.0, 5.0});
}

TEST(LppvGrid, ChildrenGrowTheBoxOfTheirParent) {
    const glm::dmat4 world_from_object = placed({1, 2, 3}, 70.0, {1, 1, 1});
    const glm::dmat4 world_from_child = glm::translate(world_from_object, glm::dvec3(4, 0, 0));
    const LppvPart parts[] = {{world_from_object, glm::dvec3(-0.5), glm::dvec3(0.5)},
                              {world_from_child, glm::dvec3(-0.5), glm::dvec3(0.5)}};
    const auto grid = make_lppv_grid({world_from_object, parts}, with_resolution({2, 2, 2}));
    ASSERT_TRUE(grid);
    expect_at(*grid, {1, 1, 1}, glm::dvec3(world_from_object * glm::dvec4(4.5, 0.5, 0.5, 1)));
}

TEST(LppvGrid, CustomBoxesStandInTheObjectsSpace) {
    LppvSettings settings = with_resolution({2, 2, 2});
    settings.bounds = LppvBounds::Custom;
    settings.custom_box = {
        {1, 0, 0}, {2, 4, 6}, glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0))};
    const auto grid = make_lppv_grid({placed({10, 0, 0}, 0.0, {1, 1, 1}), {}}, settings);
    ASSERT_TRUE(grid);
    // Turned by 90 degrees about y: local x is world -z, local z is world x.
    expect_at(*grid, {1, 1, 1}, {11.0 + 3.0, 2.0, -1.0});
}

TEST(LppvGrid, DensityTimesSizeGivesTheResolution) {
    LppvSettings settings;
    settings.density = 2.0;
    const auto grid = grid_of_cube(placed({0, 0, 0}, 20.0, {10, 0.1, 1.3}), settings);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->resolution, glm::uvec3(20, 1, 3));
}

TEST(LppvGrid, UnityTakesThePowerOfTwoThatIsNearestUpTo32) {
    LppvSettings settings = with_resolution({5, 6, 3000});
    settings.limits = LppvLimits::Unity;
    EXPECT_EQ(grid_of_cube(glm::dmat4(1.0), settings)->resolution, glm::uvec3(4, 8, 32));
    settings.resolution = {1, 2, 3};
    EXPECT_EQ(grid_of_cube(glm::dmat4(1.0), settings)->resolution, glm::uvec3(1, 2, 4));
    settings.resolution = {31, 17, 24};
    EXPECT_EQ(grid_of_cube(glm::dmat4(1.0), settings)->resolution, glm::uvec3(32, 16, 32));
}

TEST(LppvGrid, OnePointLiesInTheMiddle) {
    for (const auto placement : {LppvPlacement::CellCorners, LppvPlacement::CellCenters}) {
        LppvSettings settings = with_resolution({1, 1, 1});
        settings.placement = placement;
        const auto grid = grid_of_cube(placed({3, 4, 5}, 0.0, {2, 2, 2}), settings);
        ASSERT_TRUE(grid);
        expect_at(*grid, {0, 0, 0}, {3, 4, 5});
        EXPECT_EQ(grid->point_coordinates({100, -100, kNan}), glm::dvec3(0.0));
    }
}

TEST(LppvGrid, BoxesWithoutThicknessAreFine) {
    const LppvPart sheet{glm::dmat4(1.0), {-1, 0, -1}, {1, 0, 1}};
    for (const auto placement : {LppvPlacement::CellCorners, LppvPlacement::CellCenters}) {
        LppvSettings settings = with_resolution({2, 3, 2});
        settings.placement = placement;
        const auto grid = make_lppv_grid({glm::dmat4(1.0), std::span(&sheet, 1)}, settings);
        ASSERT_TRUE(grid);
        EXPECT_EQ(grid->world_position({0, 2, 0}).y, 0.0);
        EXPECT_EQ(grid->point_coordinates({0, 50, 0}).y, 0.0);
    }
}

TEST(LppvGrid, ObjectsScaledToNothingAreFine) {
    for (const glm::dvec3 scale : {glm::dvec3(4, 0, 2), glm::dvec3(0, 0, 2), glm::dvec3(0.0)}) {
        const glm::dmat4 world_from_object = placed({1, 2, 3}, 40.0, scale);
        const auto grid = grid_of_cube(world_from_object, with_resolution({2, 2, 2}));
        ASSERT_TRUE(grid) << error_text(grid.error());
        for (uint32_t i = 0; i < 8; ++i) {
            const glm::uvec3 point(i & 1, (i >> 1) & 1, i >> 2);
            const glm::dvec4 corner(glm::dvec3(point) - 0.5, 1.0);
            expect_at(*grid, point, glm::dvec3(world_from_object * corner));
        }
    }
}

TEST(LppvGrid, CoordinatesUndoPositionsAndClamp) {
    const auto grid = grid_of_cube(placed({1, 2, 3}, 50.0, {2, -3, 4}), with_resolution({4, 3, 9}));
    ASSERT_TRUE(grid);
    const glm::uvec3 point(3, 1, 5);
    const glm::dvec3 there = grid->world_position(point);
    EXPECT_LE(glm::distance(grid->point_coordinates(there), glm::dvec3(point)), 1e-12);
    const glm::dvec3 beyond = there + 100.0 * (there - grid->world_position({0, 0, 0}));
    EXPECT_EQ(grid->point_coordinates(beyond), glm::dvec3(3, 2, 8));
}

TEST(LppvGrid, RefusesBoundsThatAreNotFiniteOrReversed) {
    LppvSettings settings;
    EXPECT_EQ(error_of(settings, {glm::dmat4(1.0), {0, kNan, 0}, {1, 1, 1}}),
              "bounds are not finite along y: nan to 1");
    EXPECT_EQ(error_of(settings, {glm::dmat4(1.0), {0, 0, 0}, {1, 1, kInfinity}}),
              "bounds are not finite along z: 0 to inf");
    EXPECT_EQ(error_of(settings, {glm::dmat4(1.0), {2, 0, 0}, {1, 1, 1}}),
              "bounds are reversed along x: 2 to 1");
    settings.bounds = LppvBounds::Custom;
    settings.custom_box.size = {1, -2, 1};
    EXPECT_EQ(error_of(settings), "bounds are reversed along y: 1 to -1");
    settings.custom_box = {{kNan, 0, 0}, {1, 1, 1}, {1, 0, 0, 0}};
    EXPECT_NE(error_of(settings).find("the box is not finite"), std::string::npos);
}

TEST(LppvGrid, RefusesMorePointsThanAreAllowedAndSaysHowMany) {
    EXPECT_EQ(error_of(with_resolution({10'000, 1'000, 1'000})),
              "a grid of 10000 x 1000 x 1000 points (1e+10 in total) is too large: the "
              "limit is 256 along each axis");
    EXPECT_EQ(error_of(with_resolution({257, 1, 1})),
              "a grid of 257 x 1 x 1 points (257 in total) is too large: the limit is 256 along "
              "each axis");
    EXPECT_EQ(error_of(with_resolution({256, 0, 1})), "a grid of 256 x 0 x 1 points is empty");
    LppvSettings dense;
    dense.density = 1e300;
    EXPECT_NE(error_of(dense).find("is too large"), std::string::npos);
    dense.density = kNan;
    EXPECT_EQ(error_of(dense), "density is not a positive number: nan");
}

TEST(LppvGrid, RefusesTransformsThatHaveNoSpace) {
    glm::dmat4 askew(1.0);
    askew[1] = {1.0, 1e-14, 0.0, 0.0};
    const auto flattened = grid_of_cube(askew, {});
    ASSERT_FALSE(flattened);
    EXPECT_NE(error_text(flattened.error()).find("is singular"), std::string::npos);
    glm::dmat4 broken(1.0);
    broken[3].x = kNan;
    EXPECT_FALSE(grid_of_cube(broken, {}));
    glm::dmat4 perspective(1.0);
    perspective[2].w = 1.0;
    EXPECT_EQ(
        error_text(grid_of_cube(perspective, {}).error()),
        "transform of the object is not affine: its last row is (0, 0, 1, 1), not (0, 0, 0, 1)");
    EXPECT_FALSE(make_lppv_grid({}, {}));  // no parts
}

}  // namespace
}  // namespace tetralight
