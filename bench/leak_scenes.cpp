// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/leak_scenes.h>

#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr double kHouseWall = 0.2;

Mesh quad(glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Mesh mesh;
    append_quad(mesh, corner, u, v);
    return mesh;
}

Material grey(float albedo) {
    Material material;
    material.base_color = glm::vec4(glm::vec3(albedo), 1.0f);
    material.metallic = 0.0f;
    return material;
}

/// The room x in [low, low + 4]; its sides have normals that point into it.
void add_room(Scene& scene, float low, bool has_wall_at_high_x) {
    const glm::vec3 x(kRoomWide, 0, 0), y(0, kRoomHigh, 0), z(0, 0, kRoomWide), corner(low, 0, 0);
    const Material material = grey(0.7f);
    add_mesh(scene, quad(corner, z, x), material);
    add_mesh(scene, quad(corner + y, x, z), material);
    add_mesh(scene, quad(corner, x, y), material);
    add_mesh(scene, quad(corner + z, y, x), material);
    add_mesh(scene, quad(corner, y, z), material);
    if (has_wall_at_high_x) add_mesh(scene, quad(corner + x, z, y), material);
}

void add_box(Scene& scene, const glm::dvec3& min, const glm::dvec3& max) {
    add_mesh(scene, box_mesh({min, max}), grey(0.6f));
}

void add_sky_and_sun(Scene& scene) {
    scene.environment.radiance = glm::vec3(1.0f);
    Light sun;
    sun.intensity = glm::vec3(8.0f);
    sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, -0.9f));  // in through the door
    scene.lights.push_back(sun);
    scene.light_names.emplace_back("sun");
}

}  // namespace

Scene two_rooms(float thickness) {
    Scene scene;
    const float half = 0.5f * thickness;
    add_room(scene, -kRoomWide - half, thickness > 0.0f);
    add_room(scene, half, true);
    if (thickness == 0.0f) {
        // The side of the dark room at x = 0 is the wall of both.
        scene.materials[scene.meshes[scene.meshes.size() - 2].material].is_double_sided = true;
    }
    Material lamp = grey(0.0f);
    lamp.emission = glm::vec3(10.0f);
    add_mesh(scene, quad({-2.5f - half, kRoomHigh - 0.01f, 1.5f}, {1, 0, 0}, {0, 0, 1}), lamp);
    return scene;
}

WorldBox house_inside() {
    return {glm::dvec3(0.0), {6.0, 3.0, 5.0}};
}

Scene house_with_door() {
    constexpr double kDoorLeft = 2.5, kDoorRight = 3.5, kDoorTop = 2.1, kGround = 2.0;
    const double w = kHouseWall;
    const auto [low, high] = house_inside();
    Scene scene;
    add_box(scene, {low.x - kGround, low.y - w, low.z - kGround},
            {high.x + kGround, low.y, high.z + kGround});
    add_box(scene, {low.x - w, high.y, low.z - w}, {high.x + w, high.y + w, high.z + w});
    add_box(scene, {low.x - w, low.y, low.z - w}, {low.x, high.y, high.z + w});
    add_box(scene, {high.x, low.y, low.z - w}, {high.x + w, high.y, high.z + w});
    add_box(scene, {low.x, low.y, low.z - w}, {high.x, high.y, low.z});
    add_box(scene, {low.x, low.y, high.z}, {kDoorLeft, high.y, high.z + w});
    add_box(scene, {kDoorRight, low.y, high.z}, {high.x, high.y, high.z + w});
    add_box(scene, {kDoorLeft, kDoorTop, high.z}, {kDoorRight, high.y, high.z + w});
    add_sky_and_sun(scene);
    return scene;
}

std::vector<glm::dvec3> free_places(const Scene& scene, const WorldBox& box, size_t count) {
    const glm::dvec3 low = box.min + double{kLeakMargin};
    const glm::dvec3 size = box.size() - 2.0 * double{kLeakMargin};
    std::vector<glm::dvec3> candidates = random_positions(2 * count, 3, 1.0);
    for (glm::dvec3& p : candidates) p = low + p * size;
    const auto seen = probe_visibilities(scene, candidates);
    require(bool(seen), "survey");
    std::vector<glm::dvec3> free;
    for (size_t i = 0; i < candidates.size() && free.size() < count; ++i) {
        const ProbeVisibility& here = (*seen)[i];
        if (!here.is_inside() && here.surface_distance >= kLeakMargin) {
            free.push_back(candidates[i]);
        }
    }
    require(free.size() == count, "free places");
    return free;
}

}  // namespace tetralight::bench
