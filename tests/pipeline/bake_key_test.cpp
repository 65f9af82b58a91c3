// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_key.h>

#include <functional>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class BakeKey : public test::PartFixture {
  protected:
    BakeKey() {
        scene.textures.resize(1);
        scene.textures[0].image = {1, 2, {{1, 2, 3, 4}, {5, 6, 7, 8}}};
        scene.environment.image = {2, 1, {glm::vec3(1.0f), glm::vec3(2.0f)}};
    }

    /// The key after a change that is undone again.
    [[nodiscard]] uint64_t key_after(const std::function<void(BakeKey&)>& change) {
        const Scene old_scene = scene;
        const auto old_groups = groups;
        const BakeSettings old_settings = settings;
        change(*this);
        const uint64_t key = prepare().key;
        scene = old_scene;
        groups = old_groups;
        settings = old_settings;
        return key;
    }

    using Changes = std::vector<std::function<void(BakeKey&)>>;

    void expect_new_keys(const Changes& changes) {
        const uint64_t key = prepare().key;
        for (size_t i = 0; i < changes.size(); ++i) EXPECT_NE(key_after(changes[i]), key) << i;
    }

    void expect_the_same_key(const Changes& changes) {
        const uint64_t key = prepare().key;
        for (size_t i = 0; i < changes.size(); ++i) EXPECT_EQ(key_after(changes[i]), key) << i;
    }
};

TEST_F(BakeKey, ChangesWithWhatTheBakeSeesOfTheScene) {
    expect_new_keys({
        [](BakeKey& t) { t.scene.meshes[0].positions[3].y += 1e-6f; },
        [](BakeKey& t) { std::swap(t.scene.meshes[0].indices[0], t.scene.meshes[0].indices[1]); },
        [](BakeKey& t) { t.scene.meshes[0].colors.resize(4); },
        [](BakeKey& t) { t.scene.materials[0].roughness = 0.5f; },
        [](BakeKey& t) { t.scene.materials[0].bakes_emission = false; },
        [](BakeKey& t) { t.scene.textures[0].image.pixels[1][2] = 0; },
        [](BakeKey& t) {
            std::swap(t.scene.textures[0].image.width, t.scene.textures[0].image.height);
        },
        [](BakeKey& t) { t.scene.instances[0].world_from_mesh[3].x = 1e-9; },
        [](BakeKey& t) { t.scene.instances[0].contributes_gi = false; },
        [](BakeKey& t) { t.scene.lights[0].radius = 0.1f; },
        [](BakeKey& t) { t.scene.light_names[0] = "lamp"; },
        [](BakeKey& t) { t.scene.environment.rotation_radians = 1.0f; },
        [](BakeKey& t) { t.scene.portals.resize(1); },
        [](BakeKey& t) {
            t.scene.portals = {{"", {0, 1e-9, 0}, {1, 0, 0}, {0, 1, 0}}};
        },
        [](BakeKey& t) { t.scene.environment.image.pixels[1].z = 0.0f; },
    });
}

TEST_F(BakeKey, ChangesWithGroupsAndSettings) {
    expect_new_keys({
        [](BakeKey& t) { t.groups[0].positions.pop_back(); },
        [](BakeKey& t) { t.groups[0].name = "court"; },
        [](BakeKey& t) { t.groups[0].dering = true; },
        [](BakeKey& t) { t.settings.sample_count = 256; },
        [](BakeKey& t) { t.settings.bounces = 1; },
        [](BakeKey& t) { t.settings.seed = 1; },
        [](BakeKey& t) { t.settings.clamp = 1.0f; },
        [](BakeKey& t) { t.settings.target_error = 0.1; },
    });
}

TEST_F(BakeKey, StaysWithWhatChangesNoByte) {
    expect_the_same_key({
        [](BakeKey& t) { t.settings.thread_count = 1; },
        [](BakeKey& t) { t.scene.instances[0].is_walkable = true; },
        [](BakeKey& t) { t.scene.instances[0].is_in_reflections = false; },
        [](BakeKey& t) { t.scene.reflection_places.resize(1); },
        [](BakeKey& t) { std::swap(t.groups[0], t.groups[1]); },
        [](BakeKey& t) { t.scene.materials[0].name = "plaster"; },
        [](BakeKey& t) { t.scene.cameras.resize(1); },
        [](BakeKey& t) { t.scene.warnings = {"mended"}; },
        [](BakeKey& t) { t.scene.normal_maps = t.scene.textures; },
        [](BakeKey& t) { t.scene.materials[0].normal_texture.texture = 0; },
        [](BakeKey& t) { t.scene.materials[0].normal_scale = 0.5f; },
        [](BakeKey& t) { t.scene.meshes[0].tangents.resize(4); },
    });
}

}  // namespace
}  // namespace tetralight
