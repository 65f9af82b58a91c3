// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/pack_charts.h>

#include <gtest/gtest.h>

#include <map>
#include <string>

#include <tetralight/base/error_text.h>
#include <tetralight/charts/authored_uvs.h>
#include <tetralight/charts/rasterize_texels.h>
#include "tests/charts/chart_meshes.h"
#include "tests/charts/chart_oracle.h"

namespace tetralight {
namespace {

constexpr int kNoChart = -1;

/// The chart of each texel of a rectangle.
struct Footprints {
    int width = 0;
    int height = 0;
    std::vector<int> chart_of;

    [[nodiscard]] int at(int x, int y) const {
        const bool is_inside = x >= 0 && y >= 0 && x < width && y < height;
        return is_inside ? chart_of[static_cast<size_t>(y * width + x)] : kNoChart;
    }
};

/// Footprints of all charts; checks that each keeps a texel to the border and that none meet.
Footprints footprints_of(const Unwrap& charts, const PackedCharts& packed) {
    Footprints f{static_cast<int>(packed.width), static_cast<int>(packed.height), {}};
    f.chart_of.assign(static_cast<size_t>(f.width * f.height), kNoChart);
    for (size_t t = 0; t < charts.triangle_charts.size(); ++t) {
        const std::span<const glm::vec2> uvs = packed.corner_uvs;
        const int chart = static_cast<int>(charts.triangle_charts[t]);
        for_each_touched_texel(
            {uvs[3 * t], uvs[3 * t + 1], uvs[3 * t + 2]}, 0.5f, [&](int x, int y) {
                ASSERT_TRUE(x >= 1 && y >= 1 && x < f.width - 1 && y < f.height - 1);
                int& owner = f.chart_of[static_cast<size_t>(y * f.width + x)];
                ASSERT_TRUE(owner == kNoChart || owner == chart);
                owner = chart;
            });
    }
    return f;
}

/// True if a texel within `distance` of (x, y) belongs to a chart other than `chart`.
bool has_other_nearby(const Footprints& f, int x, int y, int distance, int chart) {
    for (int v = y - distance; v <= y + distance; ++v) {
        for (int u = x - distance; u <= x + distance; ++u) {
            if (f.at(u, v) != kNoChart && f.at(u, v) != chart) return true;
        }
    }
    return false;
}

void expect_gaps(const Footprints& f) {
    for (int y = 0; y < f.height; ++y) {
        for (int x = 0; x < f.width; ++x) {
            if (f.at(x, y) == kNoChart) continue;
            ASSERT_FALSE(has_other_nearby(f, x, y, 2, f.at(x, y))) << x << ", " << y;
        }
    }
}

/// Share of the texels that are in a footprint or next to one.
double used_share(const Footprints& f) {
    int used = 0;
    for (int y = 0; y < f.height; ++y) {
        for (int x = 0; x < f.width; ++x) used += has_other_nearby(f, x, y, 1, kNoChart);
    }
    return double(used) / (f.width * f.height);
}

/// Checks that edges have the length that they have in their charts, in texels, and no triangle is
/// mirrored.
void expect_same_shapes(const Unwrap& charts, const PackedCharts& packed, double density) {
    ASSERT_EQ(packed.corner_uvs.size(), charts.corner_uvs.size());
    for (size_t t = 0; t < charts.triangle_charts.size(); ++t) {
        const UvTriangle before = uv_triangle_of(charts.corner_uvs, t);
        const UvTriangle after = uv_triangle_of(packed.corner_uvs, t);
        EXPECT_NEAR(signed_area(after), density * density * signed_area(before), 0.05);
        for (size_t k = 0; k < 3; ++k) {
            const double length = glm::distance(before[k], before[(k + 1) % 3]);
            EXPECT_NEAR(glm::distance(after[k], after[(k + 1) % 3]), density * length, 1e-3);
        }
    }
}

PackedCharts expect_good_packing(const Unwrap& charts, const PackSettings& settings) {
    const Result<PackedCharts> packed = pack_charts(charts, settings);
    EXPECT_TRUE(packed);
    if (!packed) return {};
    EXPECT_LE(std::max(packed->width, packed->height), settings.max_size);
    expect_gaps(footprints_of(charts, *packed));
    expect_same_shapes(charts, *packed, settings.texels_per_meter);
    return *packed;
}

TEST(PackCharts, NoChartsNeedNoTexels) {
    EXPECT_EQ(*pack_charts({}, {}), PackedCharts{});
}

TEST(PackCharts, ARectangleHasItsFootprintAndAMargin) {
    const Unwrap charts = unwrap(plane_mesh({4.05, 2.05}, 4, 2).view());
    const PackedCharts packed = expect_good_packing(charts, {.texels_per_meter = 10});
    // 40.5 texels lie between the middles of the first and the last of 42; a margin on each side.
    EXPECT_EQ(std::minmax({packed.width, packed.height}), std::pair(22u + 2, 42u + 2));
}

TEST(PackCharts, AChartSmallerThanATexelHasAFootprintOfFour) {
    const Unwrap charts = unwrap(plane_mesh({0.01, 0.01}, 1, 1).view());
    const PackedCharts packed = expect_good_packing(charts, {.texels_per_meter = 10});
    EXPECT_EQ(packed.width, 4u);
    EXPECT_EQ(packed.height, 4u);
    EXPECT_EQ(std::ranges::count(footprints_of(charts, packed).chart_of, 0), 4);
}

TEST(PackCharts, ATriangleWithoutAreaHasAFootprint) {
    OwnedMesh mesh;
    mesh.add_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    EXPECT_EQ(expect_good_packing(unwrap(mesh.view()), {}).width, 4u);
}

TEST(PackCharts, MeshesOfManyKindsKeepTheirGaps) {
    for (const OwnedMesh& mesh :
         {box_mesh({0, 0, 0}, {1, 2, 3}), sphere_mesh(24, 12), cylinder_mesh(3.0, 36, 3),
          spiral_mesh(5.0, 0.1, 160), random_triangles(1, 30, 100)}) {
        for (const float density : {0.1f, 1.0f, 7.3f, 16.0f}) {
            expect_good_packing(unwrap(mesh.view()), {.texels_per_meter = density});
        }
    }
}

TEST(PackCharts, RandomTrianglesKeepTheirGaps) {
    for (uint32_t seed = 0; seed < 40; ++seed) {
        const OwnedMesh mesh = random_triangles(seed, 4 + seed, 1 + 2 * seed);
        SCOPED_TRACE(seed);
        expect_good_packing(unwrap(mesh.view()),
                            {.texels_per_meter = 0.5f + 0.3f * static_cast<float>(seed)});
    }
}

TEST(PackCharts, LeavesLittleOfTheRectangleEmpty) {
    OwnedMesh mesh;
    for (int i = 0; i < 200; ++i) {
        const auto x = static_cast<float>(10 * i);
        const float width = 0.2f + 0.05f * static_cast<float>(i * 7 % 40);
        const float height = 0.2f + 0.05f * static_cast<float>(i * 11 % 30);
        mesh.add_quad({x, 0, 0}, {x + width, 0, 0}, {x + width, height, 0}, {x, height, 0});
    }
    const Unwrap charts = unwrap(mesh.view());
    const PackedCharts packed = expect_good_packing(charts, {.texels_per_meter = 10});
    EXPECT_GE(used_share(footprints_of(charts, packed)), 0.85);
}

TEST(PackCharts, AuthoredUvsAreNotTurned) {
    const OwnedMesh mesh = plane_mesh({1.0, 5.0}, 1, 5);
    std::vector<glm::vec2> uvs;
    for (const glm::vec3 p : mesh.positions) uvs.push_back(0.2f * glm::vec2(p));
    const PackedCharts packed =
        expect_good_packing(keep_uvs(mesh.view(), uvs), {.texels_per_meter = 10});
    EXPECT_LT(packed.width, packed.height);
    const glm::vec2 moved = packed.corner_uvs[1] - packed.corner_uvs[0];
    EXPECT_NEAR(moved.x, 10.0f, 1e-4);
    EXPECT_NEAR(moved.y, 0.0f, 1e-4);
}

TEST(PackCharts, SaysHowLargeAChartIsThatDoesNotFit) {
    const Unwrap charts = unwrap(plane_mesh({204.75, 3.75}, 1, 1).view());
    const auto packed = pack_charts(charts, {.texels_per_meter = 10, .max_size = 1024});
    ASSERT_FALSE(packed);
    EXPECT_EQ(packed.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(packed.error().field, "texels_per_meter");
    EXPECT_EQ(packed.error().value, "10");
    // Footprints of 2048 + 1 and 38 + 1 texels, and a margin of one on each side.
    EXPECT_EQ(error_text(packed.error()),
              "chart 0 needs 2051 × 41 texels, more than the page of 1024");
}

TEST(PackCharts, FitsExactlyIntoTheLargestSize) {
    // 60.5 texels have a footprint of 62 and two of margin.
    const Unwrap charts = unwrap(plane_mesh({6.05, 6.05}, 1, 1).view());
    EXPECT_TRUE(pack_charts(charts, {.texels_per_meter = 10, .max_size = 64}));
    EXPECT_FALSE(pack_charts(charts, {.texels_per_meter = 10, .max_size = 63}));
}

TEST(PackCharts, RejectsAbsurdSizes) {
    for (const double size : {1e4, 1e9, 1e20}) {
        EXPECT_FALSE(pack_charts(unwrap(plane_mesh({size, size}, 1, 1).view()), {}));
        EXPECT_FALSE(pack_charts(unwrap(plane_mesh({size, 0.1}, 1, 1).view()), {}));
    }
}

TEST(PackCharts, RejectsMoreChartsThanFit) {
    OwnedMesh mesh;
    for (int i = 0; i < 300; ++i) {
        const auto x = static_cast<float>(10 * i);
        mesh.add_triangle({x, 0, 0}, {x + 0.01f, 0, 0}, {x, 0.01f, 0});
    }
    const Unwrap charts = unwrap(mesh.view());
    // Each needs 4 × 4 texels with its margin: 256 fit into 64 × 64.
    EXPECT_FALSE(pack_charts(charts, {.texels_per_meter = 10, .max_size = 64}));
    EXPECT_TRUE(pack_charts(charts, {.texels_per_meter = 10, .max_size = 128}));
}

TEST(PackCharts, RejectsChartsWhoseAreaFitsAndWhoseShapesDoNot) {
    OwnedMesh mesh = plane_mesh({3.8, 3.8}, 1, 1);
    mesh.add_quad({9, 0, 5}, {12.8f, 0, 5}, {12.8f, 3.8f, 5}, {9, 3.8f, 5});
    // Two squares of 42 texels with their margins.
    const auto packed = pack_charts(unwrap(mesh.view()), {.texels_per_meter = 10, .max_size = 64});
    ASSERT_FALSE(packed);
    const std::string error = error_text(packed.error());
    EXPECT_TRUE(error.starts_with("the 2 charts need at least ")) << error;
    EXPECT_TRUE(error.ends_with(" texels, more than fit into the page of 64")) << error;
}

TEST(PackCharts, GivesTheSameResultTwice) {
    const Unwrap charts = unwrap(random_triangles(2, 50, 150).view());
    EXPECT_EQ(*pack_charts(charts, {}), *pack_charts(charts, {}));
}

}  // namespace
}  // namespace tetralight
