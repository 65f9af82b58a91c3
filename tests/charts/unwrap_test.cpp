// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/unwrap.h>

#include <gtest/gtest.h>

#include "tests/charts/chart_meshes.h"
#include "tests/charts/chart_oracle.h"

namespace tetralight {
namespace {

OwnedMesh moved_and_scaled(OwnedMesh mesh, glm::vec3 offset, float scale) {
    for (glm::vec3& position : mesh.positions) position = scale * position + offset;
    return mesh;
}

size_t chart_count(const OwnedMesh& mesh) {
    return unwrap(mesh.view()).chart_sizes.size();
}

void append(OwnedMesh& mesh, const OwnedMesh& other) {
    for (size_t t = 0; t < other.triangle_count(); ++t) {
        mesh.add_triangle(glm::vec3(other.corner(t, 0)), glm::vec3(other.corner(t, 1)),
                          glm::vec3(other.corner(t, 2)));
    }
}

/// Lengths of the edges of all triangles in UV space, without those of zero-area triangles.
void expect_equal_lengths(const OwnedMesh& mesh, const Unwrap& charts) {
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const UvTriangle uv = uv_triangle_of(charts.corner_uvs, t);
        for (size_t k = 0; k < 3; ++k) {
            const double length = glm::distance(mesh.corner(t, k), mesh.corner(t, (k + 1) % 3));
            EXPECT_NEAR(glm::distance(uv[k], uv[(k + 1) % 3]), length, 1e-6 * length);
        }
    }
}

TEST(Unwrap, AnEmptyMeshHasNoCharts) {
    EXPECT_EQ(unwrap({}), Unwrap{});
}

TEST(Unwrap, ABoxHasAChartForEachFace) {
    const OwnedMesh mesh = box_mesh({0, 0, 0}, {1, 2, 3});
    const Unwrap charts = unwrap(mesh.view());
    EXPECT_EQ(charts.chart_sizes.size(), 6u);
    expect_good_charts(mesh, charts);
    expect_equal_lengths(mesh, charts);
}

TEST(Unwrap, FacesOfABoxAreAlignedToTheAxes) {
    const Unwrap charts = unwrap(box_mesh({0, 0, 0}, {1, 2, 3}).view());
    std::multiset<std::pair<float, float>> sides;
    for (const glm::vec2 size : charts.chart_sizes) sides.insert(std::minmax({size.x, size.y}));
    EXPECT_EQ(sides, (std::multiset<std::pair<float, float>>{
                         {1, 2}, {1, 2}, {1, 3}, {1, 3}, {2, 3}, {2, 3}}));
}

TEST(Unwrap, APlaneIsOneChartOfItsSize) {
    const OwnedMesh mesh = plane_mesh({4.0, 2.0}, 16, 8);
    const Unwrap charts = unwrap(mesh.view());
    ASSERT_EQ(charts.chart_sizes.size(), 1u);
    EXPECT_EQ(std::max(charts.chart_sizes[0].x, charts.chart_sizes[0].y), 4.0f);
    EXPECT_EQ(std::min(charts.chart_sizes[0].x, charts.chart_sizes[0].y), 2.0f);
    expect_good_charts(mesh, charts);
    expect_equal_lengths(mesh, charts);
}

TEST(Unwrap, ATurnedRectangleIsTurnedBack) {
    // A rectangle of 4 × 2, turned by the angle of the triangle 3, 4, 5 and tilted.
    const OwnedMesh mesh = mesh_of_surface(4, 4, [](double u, double v) {
        const double x = 4.0 * (u * 0.6) - 2.0 * (v * 0.8), y = 4.0 * (u * 0.8) + 2.0 * (v * 0.6);
        return glm::dvec3(x, 0.6 * y, 0.8 * y);
    });
    const Unwrap charts = unwrap(mesh.view());
    ASSERT_EQ(charts.chart_sizes.size(), 1u);
    EXPECT_NEAR(std::max(charts.chart_sizes[0].x, charts.chart_sizes[0].y), 4.0, 1e-5);
    EXPECT_NEAR(std::min(charts.chart_sizes[0].x, charts.chart_sizes[0].y), 2.0, 1e-5);
}

TEST(Unwrap, ACylinderNeedsAsManyChartsAsConesGoAround) {
    const OwnedMesh mesh = cylinder_mesh(5.0, 72, 4);
    const Unwrap charts = unwrap(mesh.view());
    expect_good_charts(mesh, charts);
    // Normals are 5 degrees apart. A chart has 17 columns: 80 degrees between its outer normals,
    // which is at most 84. 72 columns need 5 charts.
    EXPECT_EQ(charts.chart_sizes.size(), 5u);
}

TEST(Unwrap, ASphereIsCutIntoChartsOfLittleStretch) {
    const OwnedMesh mesh = sphere_mesh(32, 16);
    const Unwrap charts = unwrap(mesh.view());
    expect_good_charts(mesh, charts);
    // A cone of 42 degrees has (1 − cos 42°) / 2 = 1/7.8 of a sphere.
    EXPECT_GE(charts.chart_sizes.size(), 8u);
    EXPECT_LE(charts.chart_sizes.size(), 24u);
}

TEST(Unwrap, TheLargestAngleIsASetting) {
    const OwnedMesh mesh = sphere_mesh(24, 12);
    for (const float angle : {10.0f, 30.0f, 60.0f, 85.0f}) {
        expect_good_charts(mesh, unwrap(mesh.view(), {.max_angle_degrees = angle}), angle);
    }
    EXPECT_GT(unwrap(mesh.view(), {.max_angle_degrees = 10}).chart_sizes.size(),
              unwrap(mesh.view(), {.max_angle_degrees = 60}).chart_sizes.size());
}

TEST(Unwrap, ASpiralRampIsCutWhereItWouldOverlap) {
    const OwnedMesh mesh = spiral_mesh(4.0, 0.2, 128);
    const Unwrap charts = unwrap(mesh.view());
    expect_good_charts(mesh, charts);
    // All normals are within 2 degrees, and each turn covers the one below.
    EXPECT_GE(charts.chart_sizes.size(), 4u);
    EXPECT_LE(charts.chart_sizes.size(), 8u);
}

TEST(Unwrap, CrossingSheetsOfEqualNormalsAreTwoCharts) {
    OwnedMesh mesh = plane_mesh({2.0, 1.0}, 4, 1);
    // Joined to the sheet at x = 0, and lies over it.
    mesh.add_quad({0, 0, 0}, {1, 0, 0.1f}, {1, 1, 0.1f}, {0, 1, 0});
    const Unwrap charts = unwrap(mesh.view());
    EXPECT_EQ(charts.chart_sizes.size(), 2u);
    expect_good_charts(mesh, charts);
}

TEST(Unwrap, BothSidesOfALeafHaveTheirOwnChart) {
    OwnedMesh mesh = plane_mesh({1.0, 1.0}, 4, 4);
    const size_t count = mesh.triangle_count();
    for (size_t t = 0; t < count; ++t) {
        mesh.add_triangle(glm::vec3(mesh.corner(t, 0)), glm::vec3(mesh.corner(t, 2)),
                          glm::vec3(mesh.corner(t, 1)));
    }
    const Unwrap charts = unwrap(mesh.view());
    EXPECT_EQ(charts.chart_sizes.size(), 2u);
    expect_good_charts(mesh, charts);
}

TEST(Unwrap, ATriangleThatIsThereTwiceIsInTwoCharts) {
    OwnedMesh mesh;
    for (int i = 0; i < 2; ++i) mesh.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(chart_count(mesh), 2u);
}

TEST(Unwrap, ManySheetsMeetInOneEdge) {
    OwnedMesh mesh;
    for (int i = 0; i < 500; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 500.0;
        mesh.add_triangle({0, 0, 0}, {0, 0, 1}, glm::vec3(std::cos(angle), std::sin(angle), 0.5));
    }
    expect_good_charts(mesh, unwrap(mesh.view()));
}

TEST(Unwrap, ATriangleWithoutAreaLiesInTheChartOfItsNeighbor) {
    // The middle of an edge is a corner of a triangle with no area.
    OwnedMesh mesh = plane_mesh({1.0, 1.0}, 1, 1);
    mesh.add_triangle({0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0});
    mesh.add_triangle({1, 1, 0}, {1, 1, 0}, {0, 1, 0});
    const Unwrap charts = unwrap(mesh.view());
    EXPECT_EQ(charts.chart_sizes, std::vector<glm::vec2>{glm::vec2(1.0f)});
    expect_good_charts(mesh, charts);
}

TEST(Unwrap, TrianglesWithoutAreaJoinWhatLiesOnTheirSides) {
    OwnedMesh mesh = plane_mesh({1.0, 1.0}, 1, 1);
    mesh.add_triangle({0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0});
    mesh.add_triangle({0, -1, 0}, {0.5f, 0, 0}, {0, 0, 0});
    mesh.add_triangle({0.5f, 0, 0}, {1, -1, 0}, {1, 0, 0});
    EXPECT_EQ(chart_count(mesh), 1u);
}

TEST(Unwrap, ATriangleWithoutAreaAndNeighborsIsASmallChart) {
    OwnedMesh mesh;
    mesh.add_triangle({3, 3, 3}, {3, 3, 3}, {3, 3, 3});
    mesh.add_triangle({0, 0, 0}, {0, 0, 1}, {0, 0, 2});
    const Unwrap charts = unwrap(mesh.view());
    EXPECT_EQ(charts.chart_sizes.size(), 2u);
    expect_consistent(mesh, charts);
    EXPECT_EQ(charts.corner_uvs[0], glm::vec2(0.0f));
}

TEST(Unwrap, NeedlesAreNotMirrored) {
    const OwnedMesh mesh = mesh_of_surface(
        64, 1, [](double u, double v) { return glm::dvec3(1e-4 * u, 10.0 * v, 1e-5 * u); });
    expect_good_charts(mesh, unwrap(mesh.view()));
}

TEST(Unwrap, LargeAndSmallCoordinatesDoNotMatter) {
    for (const float scale : {1e-20f, 1e-6f, 1.0f, 1e6f, 1e15f}) {
        const OwnedMesh mesh = moved_and_scaled(box_mesh({0, 0, 0}, {1, 2, 3}), {}, scale);
        const Unwrap charts = unwrap(mesh.view());
        EXPECT_EQ(charts.chart_sizes.size(), 6u) << scale;
        expect_consistent(mesh, charts);
        const double area = 22.0 * scale * scale;
        EXPECT_NEAR(chart_area(charts), area, 1e-5 * area) << scale;
    }
}

TEST(Unwrap, DoesNotDependOnThePosition) {
    // The steps of 1/4 are exact at 2^20 as well.
    const OwnedMesh mesh = random_triangles(7, 60, 200);
    OwnedMesh near = mesh;
    for (glm::vec3& p : near.positions) p = glm::floor(4.0f * p) / 4.0f;
    const OwnedMesh far = moved_and_scaled(near, {0x1p20f, -0x1p20f, 0x1p19f}, 1.0f);
    EXPECT_EQ(unwrap(near.view()), unwrap(far.view()));
}

TEST(Unwrap, AMeshFarFromTheOriginHasGoodCharts) {
    const OwnedMesh mesh = moved_and_scaled(sphere_mesh(16, 8), {1e6f, -1e6f, 1e6f}, 100.0f);
    const Unwrap charts = unwrap(mesh.view());
    expect_consistent(mesh, charts);
    EXPECT_LE(overlap_within_charts(charts), 1e-5 * chart_area(charts));
}

TEST(Unwrap, GivesTheSameResultTwice) {
    const OwnedMesh mesh = random_triangles(3, 100, 300);
    EXPECT_EQ(unwrap(mesh.view()), unwrap(mesh.view()));
}

TEST(Unwrap, SeparateEqualPartsHaveEqualNumbersOfCharts) {
    OwnedMesh mesh = sphere_mesh(16, 8);
    const size_t count = chart_count(mesh);
    append(mesh, moved_and_scaled(sphere_mesh(16, 8), {4, 0, 0}, 1.0f));
    EXPECT_EQ(chart_count(mesh), 2 * count);
}

TEST(Unwrap, RandomTrianglesHaveGoodCharts) {
    for (uint32_t seed = 0; seed < 100; ++seed) {
        const OwnedMesh mesh = random_triangles(seed, 4 + seed % 40, 1 + 3 * seed);
        SCOPED_TRACE(seed);
        expect_good_charts(mesh, unwrap(mesh.view()));
    }
}

TEST(Unwrap, RandomHeightsHaveGoodCharts) {
    for (uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        OwnedMesh mesh = plane_mesh({4.0, 4.0}, 12, 12);
        std::vector<float> heights(13 * 13);
        for (float& height : heights) height = static_cast<float>(random() % 256) / 300.0f;
        for (glm::vec3& p : mesh.positions) {
            p.z = heights[static_cast<size_t>(std::lround(3.0f * p.x) * 13 +
                                              std::lround(3.0f * p.y))];
        }
        SCOPED_TRACE(seed);
        expect_good_charts(mesh, unwrap(mesh.view()));
    }
}

}  // namespace
}  // namespace tetralight
