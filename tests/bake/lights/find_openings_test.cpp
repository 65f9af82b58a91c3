// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/find_openings.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "tests/support/window_room.h"

namespace tetralight {
namespace {

void transform(Scene& scene, const glm::dmat4& world_from_scene) {
    for (MeshInstance& instance : scene.instances) {
        instance.world_from_mesh = world_from_scene * instance.world_from_mesh;
    }
}

/// Expects one opening, which is the window of `window_room` within a tenth of a metre times
/// `scale`.
void expect_the_window(const Scene& scene, const glm::dmat4& world_from_scene = glm::dmat4(1.0),
                       double scale = 1.0) {
    const TraceScene trace_scene = *TraceScene::make_static(scene);
    const std::vector<Opening> found = find_openings(trace_scene);
    ASSERT_EQ(found.size(), 1u);
    const Opening& opening = found[0];
    const glm::dvec3 center = trace_scene.world_from_render(opening.point(glm::vec2(0.5f)));
    const glm::dvec3 expected(world_from_scene * glm::dvec4(0, 1.5, -2, 1));
    EXPECT_LT(glm::distance(center, expected), 0.15 * scale);
    EXPECT_NEAR(opening.area(), scale * scale, 0.25 * scale * scale);
    const glm::vec3 inward(glm::normalize(glm::dvec3(world_from_scene * glm::dvec4(0, 0, 1, 0))));
    EXPECT_GT(glm::dot(opening.normal, inward), 0.99f);
    EXPECT_NEAR(glm::dot(opening.along, opening.across), 0.0f, 1e-4 * scale * scale);
    EXPECT_NEAR(glm::dot(glm::normalize(opening.along), opening.normal), 0.0f, 1e-4);
}

std::vector<Opening> openings_in(const Scene& scene) {
    return find_openings(*TraceScene::make_static(scene));
}

TEST(FindOpenings, FindsTheWindowOfARoom) {
    expect_the_window(test::window_room());
}

TEST(FindOpenings, FindsItOnOpenGround) {
    Scene scene = test::window_room();
    test::add_floor(scene, test::wall_material(), 30.0f, -0.05f);
    expect_the_window(scene);
}

TEST(FindOpenings, FindsItInAnyPlaceSizeAndDirection) {
    for (const double scale : {1.0, 0.01, 3.0, 100.0}) {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(1e4, -1e4, 1e4)) *
                                 glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0, 1, 0)) *
                                 glm::rotate(glm::dmat4(1.0), 0.2, glm::dvec3(1, 0, 0)) *
                                 glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
        Scene scene = test::window_room();
        transform(scene, moved);
        SCOPED_TRACE(scale);
        expect_the_window(scene, moved, scale);
    }
}

TEST(FindOpenings, FindsItBehindGlass) {
    Scene scene = test::window_room();
    Material pane = test::wall_material(glm::vec3(0.0f));
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.2f;
    test::add_quad(scene, pane, test::kWindow, test::kWindowAlong, test::kUp);
    expect_the_window(scene);
}

TEST(FindOpenings, FindsTwoWindows) {
    // The room and another one on its other side.
    Scene scene = test::window_room(), other = test::window_room();
    transform(other, glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 4.5)),
                                 std::numbers::pi, glm::dvec3(0, 1, 0)));
    const auto first_mesh = static_cast<uint32_t>(scene.meshes.size());
    for (const Mesh& mesh : other.meshes) scene.meshes.push_back(mesh);
    for (MeshInstance instance : other.instances) {
        instance.mesh += first_mesh;
        scene.instances.push_back(instance);
    }
    const std::vector<Opening> found = openings_in(scene);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_LT(glm::dot(found[0].normal, found[1].normal), -0.99f);
}

TEST(FindOpenings, FindsEachOfTheWindowsOfAWall) {
    // Three windows of 0.8 × 1 m, 0.4 m apart.
    Scene scene = test::room_with_an_open_side();
    const Material walls = test::wall_material();
    test::add_quad(scene, walls, {-2, 0, -2}, {4, 0, 0}, {0, 1, 0});
    test::add_quad(scene, walls, {-2, 2, -2}, {4, 0, 0}, {0, 1, 0});
    test::add_quad(scene, walls, {-2, 1, -2}, {0.4f, 0, 0}, {0, 1, 0});
    for (int i = 0; i < 3; ++i) {
        const float right = -1.6f + 1.2f * static_cast<float>(i) + 0.8f;
        test::add_quad(scene, walls, {right, 1, -2}, {0.4f, 0, 0}, {0, 1, 0});
    }
    const TraceScene trace_scene = *TraceScene::make_static(scene);
    std::vector<double> centers;
    for (const Opening& opening : find_openings(trace_scene)) {
        EXPECT_NEAR(opening.area(), 0.8f, 0.2f);
        centers.push_back(trace_scene.world_from_render(opening.point(glm::vec2(0.5f))).x);
    }
    std::ranges::sort(centers);
    ASSERT_EQ(centers.size(), 3u);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(centers[static_cast<size_t>(i)], 1.2 * (i - 1), 0.1);
}

TEST(FindOpenings, FindsTheWindowsOfManyRooms) {
    Scene scene;
    const Scene room = test::window_room();
    scene.materials = room.materials;
    scene.meshes = room.meshes;
    for (int i = 0; i < 25; ++i) {
        const glm::dvec3 place(5.0 * (i % 5), 0.0, 8.0 * (i / 5));
        for (MeshInstance instance : room.instances) {
            instance.world_from_mesh = glm::translate(glm::dmat4(1.0), place);
            scene.instances.push_back(instance);
        }
    }
    EXPECT_GE(openings_in(scene).size(), 20u);
}

TEST(FindOpenings, TheOpenSideOfARoomIsNone) {
    Scene scene = test::room_with_an_open_side();
    test::add_floor(scene, test::wall_material(), 30.0f, -0.05f);
    EXPECT_TRUE(openings_in(scene).empty());
}

TEST(FindOpenings, FindsNothingInSealedRoomsAndUnderTheOpenSky) {
    EXPECT_TRUE(openings_in({}).empty());
    Scene ground;
    test::add_floor(ground, test::wall_material(), 10.0f);
    test::add_box(ground, test::wall_material(), test::Facing::Outward, {0, 0, 0}, {1, 2, 1});
    EXPECT_TRUE(openings_in(ground).empty());
    Scene sealed;
    test::add_box(sealed, test::wall_material(), test::Facing::Inward, {0, 0, 0}, {4, 3, 4});
    EXPECT_TRUE(openings_in(sealed).empty());
    Scene half_sealed;
    test::add_box(half_sealed, test::wall_material(), test::Facing::Outward, {0, 0, 0}, {4, 3, 4});
    EXPECT_TRUE(openings_in(half_sealed).empty());
}

TEST(FindOpenings, SurvivesDegenerateTriangles) {
    Scene scene = test::window_room();
    test::add_quad(scene, test::wall_material(), {1, 0, 1}, {0, 0, 0}, {0, 0.1f, 0});
    test::add_quad(scene, test::wall_material(), {1, 1, 1}, {1e-20f, 0, 0}, {0, 1e-20f, 0});
    expect_the_window(scene);
}

TEST(FindOpenings, IsDeterministic) {
    const Scene scene = test::window_room();
    EXPECT_EQ(openings_in(scene), openings_in(scene));
}

}  // namespace
}  // namespace tetralight
