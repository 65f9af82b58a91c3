// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/seam_lines.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <tetralight/base/half.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// Two tiles of 1 m that meet at x = 1, and the light of each.
std::vector<GizmoLines> lines_of(float first, float second) {
    Scene scene;
    const Material grey = test::diffuse(glm::vec3(0.5f));
    test::add_quad(scene, grey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    test::add_quad(scene, grey, {1, 0, 0}, {0, 0, 1}, {1, 0, 0});
    BakeLightmapsSettings settings;
    settings.bake.sample_count = 1;
    settings.layout.page_size = 64;
    Lightmaps maps = bake_lightmaps(scene, settings)->lightmaps;
    for (size_t tile = 0; tile < 2; ++tile) {
        const LightmapRectangle& place = maps.rectangles[tile];
        const uint16_t light = half_from_float(tile == 0 ? first : second);
        for (uint32_t y = place.y; y < place.y + place.height; ++y) {
            for (uint32_t x = place.x; x < place.x + place.width; ++x)
                maps.irradiance[size_t{y} * 64 + x].rgb.fill(light);
        }
    }
    return make_seam_lines(scene, maps.view());
}

TEST(SeamLines, AreGroupedByTheDifferenceOfTheirSides) {
    const std::vector<std::pair<float, size_t>> cases{{1.005f, 0}, {1.05f, 1}, {1.5f, 2}};
    for (const auto& [light, group] : cases) {
        const auto lines = lines_of(1.0f, light);
        ASSERT_EQ(lines.size(), 3u);
        for (size_t i = 0; i < 3; ++i) EXPECT_EQ(lines[i].lines.size(), i == group ? 1u : 0u) << i;
    }
}

TEST(SeamLines, LieWhereTheTilesMeet) {
    const auto lines = lines_of(1.0f, 1.0f);
    ASSERT_EQ(lines[0].lines.size(), 1u);
    const LineSegment& line = lines[0].lines[0];
    EXPECT_NEAR(glm::distance(line[0], line[1]), 1.0, 1e-6);
    for (const glm::dvec3& end : line) EXPECT_NEAR(end.x, 1.0, 1e-6);
}

TEST(SeamLines, DarkSeamsAgree) {
    EXPECT_EQ(lines_of(0.0f, 0.0f)[0].lines.size(), 1u);
}

}  // namespace
}  // namespace tetralight
