// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/canonical_scene.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// The triangles of all instances, in the order that rays meet them in.
std::vector<glm::vec3> soup(const Scene& scene) {
    std::vector<glm::vec3> corners;
    for (const MeshInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const uint32_t i : mesh.indices) corners.push_back(mesh.positions[i]);
    }
    return corners;
}

Scene two_boxes() {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    test::add_box(scene, test::diffuse(glm::vec3(0.1f)), test::Facing::Inward, {-3, -3, -3},
                  {3, 3, 3});
    test::add_sun(scene, LightMode::Mixed, glm::vec3(1.0f));
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(2.0f), {0, 2, 0});
    return scene;
}

TEST(CanonicalScene, DoesNotDependOnTheOrderOfAnything) {
    Scene shuffled = two_boxes();
    std::swap(shuffled.instances[0], shuffled.instances[1]);
    std::swap(shuffled.lights[0], shuffled.lights[1]);
    auto& indices = shuffled.meshes[0].indices;
    std::rotate(indices.begin(), indices.begin() + 9, indices.end());
    std::rotate(indices.begin(), indices.begin() + 1, indices.begin() + 3);
    const Scene a = canonical_scene(two_boxes()), b = canonical_scene(shuffled);
    EXPECT_EQ(soup(a), soup(b));
    EXPECT_EQ(a.lights, b.lights);
}

TEST(CanonicalScene, KeepsTheTrianglesAndTheirSides) {
    const Scene scene = two_boxes();
    std::vector<glm::vec3> before = soup(scene), after = soup(canonical_scene(scene));
    const auto area_sum = [](const std::vector<glm::vec3>& corners) {
        glm::vec3 sum(0.0f);  // of normal × the first corner: signed volume
        float volume = 0.0f;
        for (size_t i = 0; i < corners.size(); i += 3) {
            volume += glm::dot(corners[i], glm::cross(corners[i + 1], corners[i + 2])) / 6.0f;
        }
        return volume + sum.x;
    };
    // 2³ outward and 6³ inward.
    EXPECT_NEAR(area_sum(before), 8.0f - 216.0f, 1e-3f);
    EXPECT_NEAR(area_sum(after), 8.0f - 216.0f, 1e-3f);
}

TEST(CanonicalScene, LeavesOutWhatMoves) {
    Scene scene = two_boxes();
    scene.instances[1].contributes_gi = false;
    EXPECT_EQ(canonical_scene(scene).instances.size(), 1u);
}

}  // namespace
}  // namespace tetralight
