// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// So many instances of a mesh of two triangles.
Scene instanced(size_t count) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f);
    scene.instances.resize(count, scene.instances[0]);
    return scene;
}

TEST(MemoryEstimate, CountsEveryStaticInstance) {
    Scene scene = instanced(1000);
    EXPECT_EQ(estimate_bake_memory(scene, 0).triangle_count, 2000u);
    for (size_t i = 0; i < 400; ++i) scene.instances[i].contributes_gi = false;
    EXPECT_EQ(estimate_bake_memory(scene, 0).triangle_count, 1200u);
    EXPECT_EQ(estimate_bake_memory(scene, 0).probe_bytes, 0u);
}

TEST(MemoryEstimate, CountsFilteredTexturesOnce) {
    Scene scene = instanced(1000);
    const uint64_t untextured = estimate_bake_memory(scene, 0).scene_bytes;
    scene.textures.push_back({"large", Image8{1024, 1024, {}}});
    scene.materials[0].base_color_texture.texture = 0;
    EXPECT_EQ(estimate_bake_memory(scene, 0).scene_bytes - untextured,
              8u * (512 * 512 + 256 * 256 + 128 * 128));
    for (MeshInstance& instance : scene.instances) instance.contributes_gi = false;
    EXPECT_EQ(estimate_bake_memory(scene, 0).scene_bytes, 0u);
}

TEST(MemoryEstimate, CountsEmissiveTrianglesAndTheSky) {
    Scene scene = instanced(1000);
    EXPECT_EQ(estimate_bake_memory(scene, 0).light_bytes, 0u);
    scene.environment.image = {64, 32, std::vector<glm::vec3>(64 * 32)};
    const uint64_t sky = estimate_bake_memory(scene, 0).light_bytes;
    EXPECT_GE(sky, 64 * 32 * sizeof(float));
    scene.materials[0].emission = glm::vec3(1.0f);
    const uint64_t light = estimate_bake_memory(scene, 0).light_bytes;
    EXPECT_GE(light - sky, 2000 * 9 * sizeof(float));  // their corners at the very least
    scene.materials[0].bakes_emission = false;
    EXPECT_EQ(estimate_bake_memory(scene, 0).light_bytes, sky);
}

TEST(MemoryEstimate, GrowsWithTheNumberOfProbes) {
    const uint64_t one = estimate_bake_memory({}, 1).total_bytes();
    EXPECT_EQ(estimate_bake_memory({}, 1000000).total_bytes(), 1000000 * one);
    EXPECT_GE(one, 27 * sizeof(float) * 2);  // radiance and irradiance at the very least
}

TEST(MemoryEstimate, GrowsWithTheLightGroups) {
    const uint64_t more = estimate_bake_memory({}, 1, 684).probe_bytes;
    EXPECT_GE(more, estimate_bake_memory({}, 1).probe_bytes + 12 * 684);
}

TEST(MemoryEstimate, RejectsTwentyGigabytesWithTheEstimate) {
    const size_t probes = 20'000'000'000 / estimate_bake_memory({}, 1).total_bytes() + 1;
    const Status status =
        check_bake_memory(estimate_bake_memory(instanced(1), probes), 8'000'000'000);
    ASSERT_FALSE(status);
    EXPECT_TRUE(error_text(status.error())
                    .starts_with("the bake needs about 20 GB of memory (2 triangles 0 GB, "))
        << error_text(status.error());
    EXPECT_TRUE(error_text(status.error()).ends_with(" probes 20 GB), 8 GB are free"));
    EXPECT_TRUE(check_bake_memory(estimate_bake_memory(instanced(1), probes), 21'000'000'000));
}

TEST(MemoryEstimate, AnOrdinaryBakeFitsIntoThisMachine) {
    EXPECT_GT(free_memory(), 50'000'000u);
    EXPECT_TRUE(check_bake_memory(estimate_bake_memory(instanced(10), 1000)));
}

}  // namespace
}  // namespace tetralight
