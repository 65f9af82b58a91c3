// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

// The same scene at other sizes and places has the same light.

namespace tetralight {
namespace {

constexpr uint32_t kSamples = 1 << 14;

/// A scene, one position in it, and where both stand in the world.
struct Placed {
    Scene scene;
    glm::dvec3 position{0.0};

    /// Scales about the origin. Lights keep their irradiance: intensity grows with the square.
    void scale(double factor) {
        place(glm::scale(glm::dmat4(1.0), glm::dvec3(factor)));
        const auto f = static_cast<float>(factor);
        for (Light& light : scene.lights) light.intensity *= f * f;
        for (Light& light : scene.lights) light.range *= f;
    }

    void place(const glm::dmat4& world_from_scene) {
        const auto placed = [&](const glm::dvec3& p) {
            return glm::dvec3(world_from_scene * glm::dvec4(p, 1.0));
        };
        for (MeshInstance& instance : scene.instances) {
            instance.world_from_mesh = world_from_scene * instance.world_from_mesh;
        }
        for (Light& light : scene.lights) light.position = placed(light.position);
        position = placed(position);
    }

    [[nodiscard]] RadianceSh light() const {
        BakeSettings settings;
        settings.sample_count = kSamples;
        const auto baked = bake_probes(scene, std::span(&position, 1), settings);
        EXPECT_TRUE(baked) << error_text(baked.error());
        return baked->radiance[0];
    }
};

/// A room with a lamp, a glowing ceiling and a block on its floor; sky through the missing wall.
/// Coordinates are sixteenths, so that floats can move them by 10 km.
Placed lit_room() {
    Placed room;
    Scene& scene = room.scene;
    scene.environment.radiance = {0.25f, 0.5f, 1.0f};
    const Material white = test::diffuse({0.75f, 0.5f, 0.25f});
    test::add_floor(scene, white, 2.0f);
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(1.0f)), 2.0f, 3.0f);
    test::add_quad(scene, white, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0});
    test::add_quad(scene, white, {-2, 0, 2}, {0, 0, -4}, {0, 3, 0});
    test::add_box(scene, white, test::Facing::Outward, {-1, 0, -1}, {0, 1, 0});
    test::add_point_light(scene, LightMode::Baked, glm::vec3(4.0f), {1.0f, 2.0f, 0.5f}).range = 9;
    room.position = {0.5, 1.5, 0.25};
    return room;
}

/// Noise of both bakes is below 1 % of the mean at this many samples; three of that.
void expect_same_light(const RadianceSh& actual, const RadianceSh& expected) {
    const float mean = glm::length(expected.coefficients[0]);
    for (int i = 0; i < kShCoefficientCount; ++i) {
        EXPECT_LT(glm::distance(actual.coefficients[i], expected.coefficients[i]), 0.03f * mean)
            << i;
    }
}

TEST(SceneScale, MillimetresAndKilometresHaveTheLightOfMetres) {
    const RadianceSh expected = lit_room().light();
    for (const double factor : {1e-3, 1e3}) {
        Placed room = lit_room();
        room.scale(factor);
        expect_same_light(room.light(), expected);
    }
}

TEST(SceneScale, TenKilometresAwayTheLightIsTheSame) {
    Placed room = lit_room();
    room.place(glm::translate(glm::dmat4(1.0), glm::dvec3(10000.0, -10000.0, 10000.0)));
    expect_same_light(room.light(), lit_room().light());
}

TEST(SceneScale, AnObjectFarAwayByMistakeCostsTheOthersNoPrecision) {
    const RadianceSh expected = lit_room().light();
    for (const float distance : {1e6f, 1e9f}) {
        Placed room = lit_room();
        test::add_quad(room.scene, test::diffuse(glm::vec3(0.5f)), glm::vec3(distance), {1, 0, 0},
                       {0, 1, 0});
        expect_same_light(room.light(), expected);
    }
}

/// A closed room, two-sided or seen from behind through its front, right beside a bright one.
Placed dark_room(bool is_double_sided) {
    Placed room;
    Scene& scene = room.scene;
    scene.environment.radiance = glm::vec3(100.0f);
    Material wall = test::diffuse(glm::vec3(0.75f));
    wall.is_double_sided = is_double_sided;
    test::add_box(scene, wall, test::Facing::Inward, {0, 0, 0}, {3, 3, 3});
    test::add_box(scene, test::diffuse(glm::vec3(0.75f), glm::vec3(100.0f)), test::Facing::Inward,
                  {3.0f + 0x1p-10f, 0, 0}, {6, 3, 3});
    room.position = {2.9, 0.1, 1.5};
    return room;
}

TEST(SceneScale, NoLightComesThroughTheWallsOfADarkRoom) {
    for (const bool is_double_sided : {false, true}) {
        for (const double factor : {1e-3, 1.0, 1e3}) {
            Placed room = dark_room(is_double_sided);
            room.scale(factor);
            EXPECT_EQ(room.light(), RadianceSh{}) << factor;
        }
        Placed room = dark_room(is_double_sided);
        room.place(glm::translate(glm::dmat4(1.0), glm::dvec3(1e4, 1e4, -1e4)));
        EXPECT_EQ(room.light(), RadianceSh{});
    }
}

}  // namespace
}  // namespace tetralight
