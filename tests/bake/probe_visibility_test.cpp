// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/probe_visibility.h>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

ProbeVisibility survey_one(const Scene& scene, const glm::dvec3& position) {
    const auto result = probe_visibilities(scene, std::span(&position, 1));
    EXPECT_TRUE(result);
    return (*result)[0];
}

Scene solid_box(bool is_double_sided) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f));
    material.is_double_sided = is_double_sided;
    test::add_box(scene, material, test::Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    return scene;
}

TEST(ProbeVisibility, InsideASolidOnlyBackFacesAreSeen) {
    const ProbeVisibility inside = survey_one(solid_box(false), {0.3, -0.5, 0.9});
    EXPECT_EQ(inside.back_face_fraction, 1.0f);
    EXPECT_EQ(inside.behind_fraction, 1.0f);
    EXPECT_TRUE(inside.is_inside());
}

TEST(ProbeVisibility, OutsideASolidNoneAreSeen) {
    EXPECT_EQ(survey_one(solid_box(false), {1.1, 0, 0}).behind_fraction, 0.0f);
    EXPECT_FALSE(survey_one(solid_box(false), {1.1, 0, 0}).is_inside());
}

TEST(ProbeVisibility, InsideADoubleSidedSolidAllIsBehindButNothingIsABackFace) {
    const ProbeVisibility inside = survey_one(solid_box(true), {0, 0, 0});
    EXPECT_EQ(inside.back_face_fraction, 0.0f);
    EXPECT_EQ(inside.behind_fraction, 1.0f);
    EXPECT_TRUE(inside.is_inside());
}

TEST(ProbeVisibility, UnderADoubleSidedSheetIsNotInside) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f));
    material.is_double_sided = true;
    test::add_floor(scene, material, 1e6f);
    const ProbeVisibility below = survey_one(scene, {0, -1, 0});
    EXPECT_NEAR(below.behind_fraction, 0.5f, 1.0f / 64.0f);  // half of the 64 rays go up
    EXPECT_FALSE(below.is_inside());
}

TEST(ProbeVisibility, WithoutSurfacesNothingIsInside) {
    EXPECT_FALSE(survey_one(Scene{}, {0, 0, 0}).is_inside());
}

TEST(ProbeVisibility, GivesEachPositionItsOwnResult) {
    const std::vector<glm::dvec3> positions = {{0, 0, 0}, {3, 0, 0}, {0, 0.9, 0}};
    const auto result = probe_visibilities(solid_box(false), positions, 2);
    ASSERT_TRUE(result);
    EXPECT_TRUE((*result)[0].is_inside());
    EXPECT_FALSE((*result)[1].is_inside());
    EXPECT_TRUE((*result)[2].is_inside());
}

}  // namespace
}  // namespace tetralight
