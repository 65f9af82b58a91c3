// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_scene.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A floor of 2 m and a mirrored one, and their lightmaps.
struct TwoFloors {
    Scene scene;
    Lightmaps maps;

    TwoFloors() {
        test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f).name = "floor";
        scene.instances.push_back(scene.instances[0]);
        scene.instances[1].world_from_mesh =
            glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(9, 0, 0)), glm::dvec3(-1, 1, 1));
        BakeLightmapsSettings settings;
        settings.bake.sample_count = 1;
        settings.layout.page_size = 64;
        maps = bake_lightmaps(scene, settings)->lightmaps;
    }
};

TEST(LightmapScene, PointsLieInTheRectangleOfTheirInstance) {
    const TwoFloors floors;
    ASSERT_TRUE(check_lightmap_scene(floors.maps.view(), floors.scene));
    for (uint32_t instance = 0; instance < 2; ++instance) {
        const LightmapRectangle& place = floors.maps.rectangles[instance];
        const double x = instance == 0 ? 0.0 : 9.0;
        const auto at = [&](double dx, double dz) {
            return 64.0f *
                   page_uv_of(floors.maps.view(), floors.scene, instance, 0, {x + dx, 0.0, dz});
        };
        // A metre is ten texels, in both directions.
        EXPECT_NEAR(glm::distance(at(0, 0), at(0.5, 0)), 5.0f, 1e-3f);
        EXPECT_NEAR(glm::distance(at(0, 0), at(0, 0.5)), 5.0f, 1e-3f);
        for (const glm::vec2& p : {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)}) {
            EXPECT_GE(p.x, static_cast<float>(place.x) + 1.0f);
            EXPECT_LE(p.x, static_cast<float>(place.x + place.width) - 1.0f);
            EXPECT_GE(p.y, static_cast<float>(place.y) + 1.0f);
            EXPECT_LE(p.y, static_cast<float>(place.y + place.height) - 1.0f);
        }
    }
}

TEST(LightmapScene, AnotherSceneIsRefusedByItsFirstDifference) {
    const TwoFloors floors;
    Scene other = floors.scene;
    other.meshes[0].positions[0].x += 0.5f;
    const Status moved = check_lightmap_scene(floors.maps.view(), other);
    ASSERT_FALSE(moved);
    EXPECT_EQ(
        error_text(moved.error()),
        "the lightmaps do not fit the object \"floor\" (instance 0): its positions or indices have "
        "changed since the lightmaps were baked");
    other = floors.scene;
    other.instances.pop_back();
    const Status fewer = check_lightmap_scene(floors.maps.view(), other);
    ASSERT_FALSE(fewer);
    EXPECT_EQ(error_text(fewer.error()), "the scene has 1 instances, the lightmaps have 2");
}

}  // namespace
}  // namespace tetralight
