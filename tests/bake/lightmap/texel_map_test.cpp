// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/texel_map.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A floor of `size` metres in texels of `texels_per_meter`, and its map.
struct Floor {
    Scene scene;
    LightmapLayout layout;
    TexelMap map;

    explicit Floor(float half_size, double texels_per_meter = 10.0, uint32_t grid = 2) {
        test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), half_size);
        layout = *make_lightmap_layout(scene, {.texels_per_meter = texels_per_meter});
        map = make_texel_map(scene.meshes[0], layout.packings[0], grid);
    }

    [[nodiscard]] glm::vec3 position(const ChartPoint& point) const {
        const Mesh& mesh = scene.meshes[0];
        const uint32_t* indices = mesh.indices.data() + size_t{3} * point.triangle;
        const glm::vec3 a = mesh.positions[indices[0]];
        return a + point.barycentric.x * (mesh.positions[indices[1]] - a) +
               point.barycentric.y * (mesh.positions[indices[2]] - a);
    }
};

TEST(TexelMap, TexelsCoverTheFloorOnce) {
    const Floor floor(1.0f);
    // 20 × 20 texels, or 21 where the floor lies across texels.
    EXPECT_GE(floor.map.texels.size(), 400u);
    EXPECT_LE(floor.map.texels.size(), 441u);
    for (size_t i = 1; i < floor.map.texels.size(); ++i) {
        EXPECT_LT(floor.map.texels[i - 1].index, floor.map.texels[i].index);
    }
}

TEST(TexelMap, SurfacesFarBelowATexelHaveOne) {
    for (const float half_size : {1e-5f, 1e-4f, 1e-3f, 1e-2f}) {
        EXPECT_GE(Floor(half_size, 4.0).map.texels.size(), 1u) << half_size;
        EXPECT_LE(Floor(half_size, 4.0).map.texels.size(), 4u) << half_size;
    }
}

TEST(TexelMap, PlacesLieInsideTheFloorAndAreEvenlySpread) {
    const Floor floor(1.0f);
    glm::vec3 sum(0.0f);
    size_t count = 0;
    for (const TexelMap::Texel& texel : floor.map.texels) {
        for (const ChartPoint& sample : floor.map.samples(texel)) {
            const glm::vec3 position = floor.position(sample);
            EXPECT_LT(std::max(std::abs(position.x), std::abs(position.z)), 1.0f);
            sum += position;
            ++count;
        }
    }
    EXPECT_NEAR(static_cast<double>(count), 4.0 * 400.0, 4.0 * 41.0);
    EXPECT_LT(glm::length(sum) / static_cast<float>(count), 0.05f);
}

TEST(TexelMap, NeighborsAreATexelApart) {
    const Floor floor(1.0f);
    const TexelMap& map = floor.map;
    for (size_t i = 1; i < map.texels.size(); ++i) {
        if (map.texels[i].index != map.texels[i - 1].index + 1) continue;
        const float distance = glm::distance(floor.position(map.center(map.texels[i])),
                                             floor.position(map.center(map.texels[i - 1])));
        EXPECT_LE(distance, 0.11f);
        EXPECT_GE(distance, 0.04f);  // texels at the border are pulled in
    }
}

TEST(TexelMap, PointsKeepAwayFromTheBorder) {
    const Floor floor(1.0f);
    for (const ChartPoint& point : floor.map.points) {
        const glm::vec3 position = floor.position(point);
        // A fiftieth of a texel, less the rounding of weights.
        EXPECT_LE(std::max(std::abs(position.x), std::abs(position.z)), 1.0f - 0.0019f);
    }
}

TEST(TexelMap, FootprintReachesHalfATexelFarther) {
    const Floor floor(1.0f);
    size_t footprint = 0;
    for (const uint32_t chart : floor.map.charts) footprint += chart == 0;
    EXPECT_GE(footprint, 21u * 21u);
    EXPECT_LE(footprint, 23u * 23u);
    for (const TexelMap::Texel& texel : floor.map.texels) {
        EXPECT_EQ(floor.map.charts[texel.index], 0u);
    }
}

TEST(TexelMap, AFloorSmallerThanATexelHasOnePlaceAtLeast) {
    const Floor floor(0.01f);
    ASSERT_GE(floor.map.texels.size(), 1u);
    for (const TexelMap::Texel& texel : floor.map.texels) {
        const glm::vec3 position = floor.position(floor.map.center(texel));
        EXPECT_LE(std::max(std::abs(position.x), std::abs(position.z)), 0.01f);
    }
}

TEST(TexelMap, TrianglesWithoutAreaAreNotSampled) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f);
    Mesh& mesh = scene.meshes[0];
    for (const uint32_t i : {0u, 0u, 1u, 2u, 2u, 2u}) mesh.indices.push_back(i);
    const auto layout = make_lightmap_layout(scene, {});
    ASSERT_TRUE(layout);
    const TexelMap map = make_texel_map(mesh, layout->packings[0], 2);
    for (const ChartPoint& point : map.points) EXPECT_LT(point.triangle, 2u);
}

}  // namespace
}  // namespace tetralight
