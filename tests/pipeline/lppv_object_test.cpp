// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_object.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/lppv_validity.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A ship with a mast that shares its volume, a passenger that does not, and a flag on the
/// passenger that would.
Scene make_ship() {
    constexpr auto kProxy = LightProbeUsage::ProxyVolume;
    Scene scene;
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(10, 0, 0));
    scene.nodes = {{"ship", kNoIndex, moved, kProxy},
                   {"mast", 0, moved, kProxy},
                   {"passenger", 0, moved, LightProbeUsage::Blend},
                   {"flag", 2, moved, kProxy}};
    const float heights[] = {1.0f, 9.0f, 3.0f, 4.0f};
    for (uint32_t node = 0; node < 4; ++node) {
        MeshInstance& box = test::add_box(scene, {}, test::Facing::Outward, glm::vec3(-1, 0, -1),
                                          glm::vec3(1, heights[node], 1));
        box.world_from_mesh = moved;
        box.node = node;
        box.contributes_gi = false;
    }
    return scene;
}

TEST(LppvObject, HoldsTheNodeAndChildrenThatAskForIt) {
    const Scene scene = make_ship();
    const auto object = find_object(scene, "ship");
    ASSERT_TRUE(object);
    EXPECT_EQ(object->instances, (std::vector<uint32_t>{0, 1}));
    const auto grid = make_lppv_grid(object->view(), {});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->max, glm::dvec3(1, 9, 1));  // in the ship's space
    EXPECT_EQ(grid->world_position({0, 0, 0}).x, 9.0);
}

TEST(LppvObject, ANodeThatIsNamedNeedNotAsk) {
    const auto object = find_object(make_ship(), "passenger");
    ASSERT_TRUE(object);
    EXPECT_EQ(object->instances, (std::vector<uint32_t>{2, 3}));
}

TEST(LppvObject, FindsAllThatMoveAndAsk) {
    Scene scene = make_ship();
    const auto objects = find_proxy_objects(scene);
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_EQ(objects[0].instances, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(objects[1].instances, (std::vector<uint32_t>{3}));
    for (MeshInstance& instance : scene.instances) instance.contributes_gi = true;
    EXPECT_TRUE(find_proxy_objects(scene).empty());
}

TEST(LppvObject, NamesNodesThatAreNotThereOnce) {
    Scene scene = make_ship();
    EXPECT_EQ(error_text(find_object(scene, "boat").error()), "there is no node \"boat\"");
    scene.nodes[3].name = "mast";
    EXPECT_EQ(error_text(find_object(scene, "mast").error()), "there are several nodes \"mast\"");
}

TEST(LppvObject, ErrorsOfItsGridNameTheNode) {
    LppvSettings settings;
    settings.density = 100.0;
    const auto grid = make_object_grid(*find_object(make_ship(), "ship"), settings);
    ASSERT_FALSE(grid);
    EXPECT_EQ(error_text(grid.error()).find("node \"ship\": a grid of 200 x 900 x 200 points"), 0u);
}

TEST(LppvValidity, PointsInSolidsAreInvalid) {
    Scene scene;
    test::add_box(scene, {}, test::Facing::Outward, glm::vec3(-1.0f), glm::vec3(1.0f));
    const LppvPart box{glm::dmat4(1.0), glm::dvec3(-3.0, 0.1, 0.1), glm::dvec3(3.0, 0.1, 0.1)};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = {5, 1, 1};
    const auto grid = make_lppv_grid({glm::dmat4(1.0), std::span(&box, 1)}, settings);
    const auto validity = lppv_grid_validity(scene, *grid, 1);
    ASSERT_TRUE(validity);
    EXPECT_EQ(*validity, (std::vector<float>{1, 1, 0, 1, 1}));
}

}  // namespace
}  // namespace tetralight
