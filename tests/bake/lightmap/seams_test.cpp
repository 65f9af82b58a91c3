// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/seams.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const Material kGrey = test::diffuse(glm::vec3(0.5f));

std::vector<Seam> seams_of(const Scene& scene) {
    const auto layout = make_lightmap_layout(scene, {});
    EXPECT_TRUE(layout);
    return find_seams(scene, *layout, std::vector<bool>(scene.instances.size(), true));
}

/// 3 × 3 tiles of one mesh, 1 m each.
Scene tiles() {
    Scene scene;
    for (int i = 0; i < 9; ++i) {
        if (i == 0) {
            test::add_floor(scene, kGrey, 0.5f);
        } else {
            scene.instances.push_back(scene.instances[0]);
        }
        scene.instances.back().world_from_mesh =
            glm::translate(glm::dmat4(1.0), glm::dvec3(i % 3, 0.3, i / 3));
    }
    return scene;
}

TEST(Seams, TilesOfOneFloorMeetAtTwelveEdges) {
    const auto seams = seams_of(tiles());
    EXPECT_EQ(seams.size(), 12u);
    for (const Seam& seam : seams) {
        EXPECT_NE(seam.first, seam.second);
        EXPECT_NEAR(glm::distance(seam.first.begin, seam.first.end), 10.0f, 1e-3f);
        EXPECT_NEAR(glm::distance(seam.second.begin, seam.second.end), 10.0f, 1e-3f);
    }
}

TEST(Seams, TilesApartDoNotMeet) {
    Scene scene = tiles();
    for (size_t i = 0; i < 9; ++i)
        scene.instances[i].world_from_mesh[3].y = i % 2 == 0 ? 0.0 : 0.001;
    EXPECT_EQ(seams_of(scene).size(), 0u);
}

TEST(Seams, TilesLeftAloneDoNotMeet) {
    const Scene scene = tiles();
    std::vector<bool> joins(9, true);
    joins[4] = false;
    EXPECT_EQ(find_seams(scene, *make_lightmap_layout(scene, {}), joins).size(), 8u);
}

TEST(Seams, FacesOfABoxDoNotMeet) {
    Scene scene;
    test::add_box(scene, kGrey, test::Facing::Outward, {0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(seams_of(scene).size(), 0u);
}

/// The side of a cylinder of radius 1 and height 1, without caps.
Mesh cylinder(int sides) {
    Mesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        const glm::vec3 normal(std::sin(angle), 0, std::cos(angle));
        for (const float y : {0.0f, 1.0f}) {
            mesh.positions.push_back(normal + glm::vec3(0, y, 0));
            mesh.normals.push_back(normal);
        }
    }
    const auto count = static_cast<uint32_t>(2 * sides);
    for (uint32_t i = 0; i < count; i += 2) {
        const uint32_t a = i, b = i + 1, c = (i + 2) % count, d = (i + 3) % count;
        for (const uint32_t k : {a, c, b, b, c, d}) mesh.indices.push_back(k);
    }
    return mesh;
}

TEST(Seams, ChartsOfASmoothCylinderMeetAllAround) {
    Scene scene;
    test::add_mesh(scene, kGrey, cylinder(32));
    const auto layout = make_lightmap_layout(scene, {});
    ASSERT_TRUE(layout);
    const auto& charts = layout->packings[0].triangle_charts;
    const size_t chart_count = *std::max_element(charts.begin(), charts.end()) + 1;
    EXPECT_GE(chart_count, 4u);
    // Each chart ends where the next one begins, at an edge of 10 texels.
    const auto seams = find_seams(scene, *layout, {true});
    EXPECT_EQ(seams.size(), chart_count);
    for (const Seam& seam : seams)
        EXPECT_NEAR(glm::distance(seam.first.begin, seam.first.end), 10.0f, 0.01f);
}

TEST(Seams, FlatFacetsOfACylinderDoNotMeet) {
    Scene scene;
    Mesh mesh = cylinder(12);
    mesh.normals.clear();
    test::add_mesh(scene, kGrey, std::move(mesh));
    EXPECT_EQ(seams_of(scene).size(), 0u);
}

}  // namespace
}  // namespace tetralight
