// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/virtual_offset.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr float kMargin = 0.1f;

std::optional<glm::vec3> offset(const Scene& scene, const glm::dvec3& position,
                                float reach = 10.0f) {
    const auto trace_scene = TraceScene::make_static(scene);
    EXPECT_TRUE(trace_scene);
    return find_virtual_offset(*trace_scene, trace_scene->render_from_world(position),
                               {reach, kMargin});
}

void add_solid(Scene& scene, glm::vec3 low, glm::vec3 high, bool is_double_sided = false) {
    Material material = test::diffuse(glm::vec3(0.5f));
    material.is_double_sided = is_double_sided;
    test::add_box(scene, material, test::Facing::Outward, low, high);
}

Scene solid_box(bool is_double_sided = false) {
    Scene scene;
    add_solid(scene, {-1, -1, -1}, {1, 1, 1}, is_double_sided);
    return scene;
}

void expect_near(const std::optional<glm::vec3>& actual, glm::vec3 expected) {
    ASSERT_TRUE(actual);
    EXPECT_LT(glm::distance(*actual, expected), 1e-3f)
        << actual->x << " " << actual->y << " " << actual->z;
}

TEST(VirtualOffset, EndsAtTheMarginBeyondTheNearestFace) {
    expect_near(offset(solid_box(), {0.1, 0.7, -0.2}), {0, 0.3f + kMargin, 0});
    expect_near(offset(solid_box(), {-0.95, 0.7, -0.2}), {-0.05f - kMargin, 0, 0});
}

TEST(VirtualOffset, LeadsOutOfADoubleSidedSolid) {
    expect_near(offset(solid_box(true), {0.1, 0.7, -0.2}), {0, 0.3f + kMargin, 0});
}

TEST(VirtualOffset, IsLimitedByTheMaximumDistance) {
    EXPECT_TRUE(offset(solid_box(), {0, 0.7, 0}, 0.41f));
    EXPECT_FALSE(offset(solid_box(), {0, 0.7, 0}, 0.39f));  // less than 0.3 and the margin
}

TEST(VirtualOffset, DoesNotLeadFromOneSolidIntoAnother) {
    // A second solid stands over the top; the next way out is the side at x = 1.
    Scene scene = solid_box();
    add_solid(scene, {-3, 0.9f, -3}, {3, 5, 3});
    const auto found = offset(scene, {0.6, 0.7, 0});
    ASSERT_TRUE(found);
    EXPECT_GT(found->x, 0.4f);
    EXPECT_LT(found->y, 0.2f);  // below the second solid
}

TEST(VirtualOffset, StaysInTheMiddleOfANarrowGap) {
    Scene scene = solid_box();
    add_solid(scene, {-3, 1.06f, -3}, {3, 5, 3});
    expect_near(offset(scene, {0, 0.9, 0}), {0, 0.1f + 0.03f, 0});
}

TEST(VirtualOffset, LeadsUpThroughTheGround) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 100.0f);
    expect_near(offset(scene, {3, -0.25, 2}), {0, 0.25f + kMargin, 0});
}

TEST(VirtualOffset, DoesNotPassThroughFronts) {
    // A hollow that faces inward within solid rock: what lies behind its front is no way out.
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Inward, {-1, -1, -1},
                  {1, 1, 1});
    EXPECT_FALSE(offset(scene, {0, 0, 0}));
}

TEST(VirtualOffset, IsTheSameOnTranslatedAndScaledScenes) {
    Scene scene = solid_box();
    scene.instances[0].world_from_mesh[3] = glm::dvec4(1e4, -2e4, 5e3, 1.0);
    expect_near(offset(scene, {1e4 + 0.1, -2e4 + 0.7, 5e3 - 0.2}), {0, 0.3f + kMargin, 0});
}

}  // namespace
}  // namespace tetralight
