// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/authored_uvs.h>

#include <gtest/gtest.h>

#include <limits>

#include "tests/charts/chart_meshes.h"
#include "tests/charts/chart_oracle.h"

namespace tetralight {
namespace {

/// The x and y of the positions of a mesh as its UVs.
std::vector<glm::vec2> flat_uvs(const OwnedMesh& mesh, glm::vec2 scale = glm::vec2(1.0f),
                                glm::vec2 offset = glm::vec2(0.0f)) {
    std::vector<glm::vec2> uvs;
    for (const glm::vec3 p : mesh.positions) uvs.push_back(glm::vec2(p) * scale + offset);
    return uvs;
}

/// Two unit squares, the second moved by an offset.
OwnedMesh two_squares(glm::vec2 offset) {
    OwnedMesh mesh = plane_mesh({1.0, 1.0}, 1, 1);
    const glm::vec3 o(offset, 1.0f);
    mesh.add_quad(o, o + glm::vec3(1, 0, 0), o + glm::vec3(1, 1, 0), o + glm::vec3(0, 1, 0));
    return mesh;
}

TEST(CheckUvs, AnEmptyMeshHasNoArea) {
    EXPECT_EQ(check_uvs({}, {}), UvCheck{});
}

TEST(CheckUvs, TrianglesWithCommonEdgesDoNotOverlap) {
    const OwnedMesh mesh = plane_mesh({1.0, 1.0}, 37, 23);
    const UvCheck check = check_uvs(mesh.view(), flat_uvs(mesh));
    EXPECT_EQ(check.overlap_area, 0.0);
    EXPECT_NEAR(check.area, 1.0, 1e-5);
    EXPECT_EQ(check.outside_count, 0u);
}

TEST(CheckUvs, FansOfRandomTrianglesDoNotOverlap) {
    std::mt19937 random(5);
    OwnedMesh mesh = plane_mesh({1.0, 1.0}, 20, 20);
    std::vector<glm::vec2> moves(21 * 21);
    for (glm::vec2& move : moves) {
        const float x = static_cast<float>(random() % 1000) / 1e5f;
        move = {x, static_cast<float>(random() % 1000) / 1e5f};
    }
    for (glm::vec3& p : mesh.positions) {
        p += glm::vec3(
            moves[static_cast<size_t>(std::lround(20 * p.x) * 21 + std::lround(20 * p.y))], 0.0f);
    }
    EXPECT_EQ(check_uvs(mesh.view(), flat_uvs(mesh)).overlap_area, 0.0);
}

TEST(CheckUvs, MeasuresTheOverlapOfTwoSquares) {
    const OwnedMesh mesh = two_squares({0.5f, 0.25f});
    const UvCheck check = check_uvs(mesh.view(), flat_uvs(mesh));
    // 0.5 × 0.75; the samples are 1.5 / 2048 and 1.25 / 2048 apart.
    EXPECT_NEAR(check.overlap_area, 0.375, 2.5 * 0.5 * 1.5 / 2048);
    EXPECT_EQ(check.area, 2.0);
}

TEST(CheckUvs, CountsAnAreaOnceHoweverManyTrianglesCoverIt) {
    OwnedMesh mesh;
    for (int i = 0; i < 5; ++i) mesh.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const UvCheck check = check_uvs(mesh.view(), flat_uvs(mesh));
    EXPECT_NEAR(check.overlap_area, 0.5, 2.0 / 2048);
    EXPECT_EQ(check.area, 2.5);
}

TEST(CheckUvs, MirroredTrianglesOverlapToo) {
    OwnedMesh mesh;
    mesh.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.add_triangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    EXPECT_NEAR(check_uvs(mesh.view(), flat_uvs(mesh)).overlap_area, 0.5, 2.0 / 2048);
}

TEST(CheckUvs, TakesUvsThatAreFarAway) {
    const OwnedMesh mesh = two_squares({0.5f, 0.0f});
    const auto uvs = flat_uvs(mesh, glm::vec2(1.0f), glm::vec2(0x1p20f, -0x1p20f));
    const UvCheck check = check_uvs(mesh.view(), uvs);
    EXPECT_NEAR(check.overlap_area, 0.5, 2.0 / 2048);
    EXPECT_EQ(check.outside_count, 12u);
}

TEST(CheckUvs, TakesUvsOfAnySize) {
    const OwnedMesh mesh = plane_mesh({1.0, 1.0}, 50, 50);
    for (const float scale : {1e-30f, 1e6f, 1e37f}) {
        const UvCheck check = check_uvs(mesh.view(), flat_uvs(mesh, glm::vec2(scale)));
        EXPECT_EQ(check.overlap_area, 0.0) << scale;
        EXPECT_NEAR(check.area / scale / scale, 1.0, 1e-5) << scale;
    }
}

TEST(CheckUvs, UvsOnALineHaveNoArea) {
    const OwnedMesh mesh = plane_mesh({1.0, 1.0}, 2, 2);
    const UvCheck check = check_uvs(mesh.view(), flat_uvs(mesh, {1.0f, 0.0f}));
    EXPECT_EQ(check.overlap_area, 0.0);
    EXPECT_EQ(check.area, 0.0);
}

TEST(CheckUvs, CountsCornersOutsideTheUnitSquare) {
    OwnedMesh mesh;
    mesh.add_triangle({-0.00005f, 0, 0}, {1.00005f, 0, 0}, {1, 1, 0});
    mesh.add_triangle({-0.0002f, 0, 0}, {1, 1.0002f, 0}, {0, 1, 0});
    EXPECT_EQ(check_uvs(mesh.view(), flat_uvs(mesh)).outside_count, 2u);
}

TEST(CheckUvs, NumbersThatAreNotFiniteAreOutside) {
    const OwnedMesh mesh = plane_mesh({1.0, 1.0}, 1, 1);
    std::vector<glm::vec2> uvs = flat_uvs(mesh);
    uvs[0].x = std::numeric_limits<float>::quiet_NaN();
    uvs[1].y = std::numeric_limits<float>::infinity();
    const UvCheck check = check_uvs(mesh.view(), uvs);
    EXPECT_EQ(check.outside_count, 2u);
    EXPECT_EQ(check.area, 0.5);
}

TEST(KeepUvs, MakesOneChartWithTheAreaOfTheSurface) {
    const OwnedMesh mesh = box_mesh({0, 0, 0}, {2, 3, 4});
    std::vector<glm::vec2> uvs;
    for (const glm::vec3 p : mesh.positions) uvs.push_back({p.x + 0.3f * p.z + 7.0f, p.y - 9.0f});
    const Unwrap charts = keep_uvs(mesh.view(), uvs);
    EXPECT_EQ(charts.chart_sizes.size(), 1u);
    EXPECT_EQ(charts.rotation, ChartRotation::Fixed);
    expect_consistent(mesh, charts);
    EXPECT_NEAR(chart_area(charts), 52.0, 1e-4);
}

TEST(KeepUvs, KeepsTheShape) {
    const OwnedMesh mesh = plane_mesh({4.0, 2.0}, 4, 2);
    const auto uvs = flat_uvs(mesh, {0.125f, 0.125f}, {0.25f, 0.5f});
    const Unwrap charts = keep_uvs(mesh.view(), uvs);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_EQ(charts.corner_uvs[i], glm::vec2(mesh.positions[i])) << i;
    }
    EXPECT_EQ(charts.chart_sizes[0], glm::vec2(4.0f, 2.0f));
}

TEST(KeepUvs, StretchAlongAnAxisIsUndone) {
    // UVs from 0 to 1 on both sides of a wall of 8 x 2 m, as packers write them.
    const OwnedMesh mesh = plane_mesh({8.0, 2.0}, 4, 2);
    const Unwrap charts = keep_uvs(mesh.view(), flat_uvs(mesh, {0.125f, 0.5f}));
    EXPECT_NEAR(charts.chart_sizes[0].x, 8.0f, 1e-4f);
    EXPECT_NEAR(charts.chart_sizes[0].y, 2.0f, 1e-4f);
}

TEST(CheckUvs, TellsWhatHasNoArea) {
    const OwnedMesh mesh = plane_mesh({4.0, 2.0}, 4, 2);
    EXPECT_EQ(check_uvs(mesh.view(), flat_uvs(mesh, {0.25f, 0.5f})).lost_fraction, 0.0);
    EXPECT_EQ(check_uvs(mesh.view(), flat_uvs(mesh, {0.25f, 0.0f})).lost_fraction, 1.0);
    // The left half of the surface on a line.
    auto uvs = flat_uvs(mesh, {0.25f, 0.5f});
    for (glm::vec2& uv : uvs) uv.x = std::max(uv.x, 0.5f);
    EXPECT_NEAR(check_uvs(mesh.view(), uvs).lost_fraction, 0.5, 1e-6);
}

TEST(KeepUvs, UvsWithoutAreaBecomeAPoint) {
    const OwnedMesh mesh = plane_mesh({4.0, 2.0}, 1, 1);
    const Unwrap charts = keep_uvs(mesh.view(), flat_uvs(mesh, {1.0f, 0.0f}));
    EXPECT_EQ(charts.chart_sizes, std::vector<glm::vec2>{glm::vec2(0.0f)});
    EXPECT_EQ(keep_uvs({}, {}).chart_sizes.size(), 0u);
}

}  // namespace
}  // namespace tetralight
