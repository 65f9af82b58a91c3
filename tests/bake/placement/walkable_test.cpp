// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/walkable.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Triangles = std::vector<WorldTriangle>;

/// Two triangles over corner, corner + u, corner + u + v, corner + v; they face along u × v.
void add_quad(Triangles& triangles, const glm::dvec3& corner, const glm::dvec3& u,
              const glm::dvec3& v) {
    triangles.push_back({corner, corner + u, corner + u + v});
    triangles.push_back({corner, corner + u + v, corner + v});
}

/// A level square of 2 m around a center.
void add_square(Triangles& triangles, const glm::dvec3& center) {
    add_quad(triangles, center - glm::dvec3(1, 0, 1), {0, 0, 2}, {2, 0, 0});
}

WalkableSurface surface_of(const Triangles& triangles) {
    auto surface = WalkableSurface::make(triangles);
    EXPECT_TRUE(surface) << error_text(surface.error());
    return std::move(*surface);
}

std::vector<double> heights_in_column(const WalkableSurface& surface, double x, double z) {
    std::vector<double> heights;
    for (const glm::dvec3& foot : surface.feet_in_column(x, z, 100.0, -100.0)) {
        EXPECT_EQ(glm::dvec2(foot.x, foot.z), glm::dvec2(x, z));
        heights.push_back(foot.y);
    }
    return heights;
}

TEST(WalkableSurface, HeightIsAboveTheNearestPlaceBelow) {
    Triangles triangles;
    add_square(triangles, {0, 0, 0});
    add_square(triangles, {0, 3, 0});
    const WalkableSurface surface = surface_of(triangles);
    EXPECT_EQ(surface.height_above({0.3, 2.5, 0.2}), 2.5);
    EXPECT_EQ(surface.height_above({0.3, 3.5, 0.2}), 0.5);
    EXPECT_EQ(surface.height_above({0.3, 1e6, 0.2}), 1e6 - 3.0);
    EXPECT_EQ(surface.height_above({0.3, -0.5, 0.2}), std::nullopt);
    EXPECT_EQ(surface.height_above({1.5, 2.5, 0.2}), std::nullopt);
}

TEST(WalkableSurface, HoldsFromACentimetreBelowUpToTheAgentsHeight) {
    Triangles triangles;
    add_square(triangles, {0, 1, 0});
    const WalkableSurface surface = surface_of(triangles);
    EXPECT_EQ(surface.height_above({0, 0.991, 0}), 0.0);
    EXPECT_FALSE(surface.holds({0, 0.989, 0}, 2.0));
    EXPECT_TRUE(surface.holds({0, 3.0, 0}, 2.0));
    EXPECT_FALSE(surface.holds({0, 3.001, 0}, 2.0));
}

TEST(WalkableSurface, FeetStandOnAllStoreysFromAbove) {
    Triangles triangles;
    for (const double y : {0.0, 6.0, 3.0}) add_square(triangles, {0, y, 0});
    const WalkableSurface surface = surface_of(triangles);
    EXPECT_EQ(heights_in_column(surface, 0.5, 0.1), (std::vector<double>{6, 3, 0}));
    const auto between = surface.feet_in_column(0.5, 0.1, 5.0, 1.0);
    ASSERT_EQ(between.size(), 1u);
    EXPECT_EQ(between[0], glm::dvec3(0.5, 3.0, 0.1));
}

TEST(WalkableSurface, SteepAndDownwardTrianglesDoNotCount) {
    Triangles triangles;
    add_square(triangles, {0, 0, 0});
    add_quad(triangles, {-1, 5, -1}, {2, 0, 0}, {0, 0, 2});     // faces down
    add_quad(triangles, {-1, 6, -1}, {0, 0, 2}, {2, 3.6, 0});   // 61°
    add_quad(triangles, {-1, 10, -1}, {0, 0, 2}, {2, 3.4, 0});  // 59.5°
    const auto heights = heights_in_column(surface_of(triangles), 0.5, 0.1);
    ASSERT_EQ(heights.size(), 2u);
    EXPECT_NEAR(heights[0], 10.0 + 1.5 * 1.7, 1e-12);
    EXPECT_EQ(heights[1], 0.0);
}

/// Columns on the edges and corners of a field of tiles.
void expect_one_foot_everywhere(const WalkableSurface& surface, const glm::dvec3& center) {
    for (int i = -8; i <= 8; ++i) {
        for (int j = -8; j <= 8; ++j) {
            const double x = center.x + i / 8.0 * 3.0, z = center.z + j / 8.0 * 3.0;
            const auto feet = surface.feet_in_column(x, z, center.y + 1.0, center.y - 1.0);
            ASSERT_EQ(feet.size(), 1u) << i << ' ' << j;
            EXPECT_NEAR(feet[0].y, center.y, 1e-9) << i << ' ' << j;
        }
    }
}

/// 3 by 3 tiles of 2 m, each `gap` away from the next.
Triangles tiles(const glm::dvec3& center, double gap) {
    Triangles triangles;
    for (const int i : {-1, 0, 1}) {
        for (const int j : {-1, 0, 1}) {
            add_quad(triangles, center + glm::dvec3(2 * i - 1 + gap / 2, 0, 2 * j - 1 + gap / 2),
                     {0, 0, 2 - gap}, {2 - gap, 0, 0});
        }
    }
    return triangles;
}

TEST(WalkableSurface, AColumnThroughAnEdgeFindsOneFoot) {
    for (const glm::dvec3& center : {glm::dvec3(0.0), glm::dvec3(4e6, 700.0, -3e6)}) {
        expect_one_foot_everywhere(surface_of(tiles(center, 0.0)), center);
        expect_one_foot_everywhere(surface_of(tiles(center, 2e-5)), center);
    }
}

TEST(WalkableSurface, HeightAboveAGapIsThatOfTheUpperStorey) {
    Triangles triangles = tiles({0, 3, 0}, 2e-5);
    add_square(triangles, {1, 0, 1});
    EXPECT_EQ(surface_of(triangles).height_above({1.0, 4.0, 0.5}), 1.0);
}

TEST(WalkableSurface, FarFromTheOriginHeightsAreExactToANanometre) {
    const glm::dvec3 center(5e6, 2000.0, -3e6);
    Triangles triangles;
    add_quad(triangles, center - glm::dvec3(1, 0, 1), {0, 0, 2}, {2, 1, 0});
    const auto height = surface_of(triangles).height_above(center + glm::dvec3(0.5, 2.0, 0.25));
    ASSERT_TRUE(height);
    EXPECT_NEAR(*height, 2.0 - 0.75, 1e-9);
}

TEST(WalkableSurface, TheOrderOfTrianglesChangesNoBit) {
    Triangles triangles;
    for (int i = 0; i < 50; ++i) {  // a hilly strip: folds at every edge
        const double low = std::sin(i), high = std::sin(i + 1);
        add_quad(triangles, {0.3 * i, 0.1 * low, 0.0}, {0, 0, 1}, {0.3, 0.1 * (high - low), 0});
    }
    const WalkableSurface first = surface_of(triangles);
    std::ranges::reverse(triangles);
    for (WorldTriangle& triangle : triangles) std::ranges::rotate(triangle, triangle.begin() + 1);
    const WalkableSurface second = surface_of(triangles);
    for (int i = 0; i <= 150; ++i) {
        const glm::dvec3 position(0.1 * i, 1.0, 0.1 * i / 15.0);
        EXPECT_EQ(first.height_above(position), second.height_above(position)) << i;
    }
}

TEST(WalkableSurface, RefusesWhatIsNoSurface) {
    EXPECT_FALSE(WalkableSurface::make({}));
    Triangles triangles;
    add_quad(triangles, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
    const auto downward = WalkableSurface::make(triangles);
    ASSERT_FALSE(downward);
    EXPECT_EQ(error_text(downward.error()),
              "none of 2 walkable triangles faces up, less than 60° off level");
    triangles[1][2].z = std::numeric_limits<double>::quiet_NaN();
    const auto infinite = WalkableSurface::make(triangles);
    ASSERT_FALSE(infinite);
    EXPECT_EQ(error_text(infinite.error()), "walkable triangle 1 is not finite");
}

TEST(WalkableTriangles, AreThoseOfWalkableInstancesInTheWorld) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    MeshInstance& helper = test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f);
    helper.is_walkable = true;
    helper.contributes_gi = false;
    helper.world_from_mesh[0][0] = -1.0;  // mirrored: its front still faces up
    helper.world_from_mesh[3] = {1e7, 5.0, 0.0, 1.0};
    const Triangles triangles = walkable_triangles(scene);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(surface_of(triangles).height_above({1e7 + 0.5, 6.0, 0.5}), 1.0);
}

TEST(ReadWalkable, TakesAllMeshesOfAFile) {
    const TempFolder folder;
    // A level triangle (0,0,0), (0,0,1), (1,0,0), moved 2 m up.
    const std::string path =
        folder.write("walk.gltf", R"({"asset": {"version": "2.0"},
        "nodes": [{"mesh": 0, "translation": [0, 2, 0], "extras": {"walkable": false}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                                  "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"
                                  R"("}]})");
    const auto triangles = read_walkable(path);
    ASSERT_TRUE(triangles) << error_text(triangles.error());
    EXPECT_EQ(*triangles, (Triangles{{{{0, 2, 0}, {0, 2, 1}, {1, 2, 0}}}}));
}

TEST(ReadWalkable, NamesAFileWithoutMeshes) {
    const TempFolder folder;
    const std::string path = folder.write("bare.gltf", R"({"asset": {"version": "2.0"}})");
    const auto triangles = read_walkable(path);
    ASSERT_FALSE(triangles);
    EXPECT_EQ(error_text(triangles.error()), path + ": contains no mesh to walk on");
}

}  // namespace
}  // namespace tetralight
