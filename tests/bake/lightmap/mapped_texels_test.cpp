// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/mapped_texels.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>

#include "tests/support/mapped_wall.h"

namespace tetralight {
namespace {

/// The mapped normals of all texels of a scene, and their own normals.
struct Mapped {
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> own;

    explicit Mapped(const Scene& scene) {
        const auto traced = TraceScene::make_static(scene);
        const auto layout = make_lightmap_layout(scene, {});
        const auto maps = make_texel_maps(scene, *layout, {});
        const auto texels = make_lightmap_texels(scene, *traced, *layout, maps, {});
        std::vector<uint32_t> all(texels->positions.size());
        std::iota(all.begin(), all.end(), 0u);
        normals = make_mapped_normals(scene, *layout, maps, *texels, all);
        for (const TexelSurfaces::Texel& texel : texels->surfaces) own.push_back(texel.normal);
    }
};

TEST(MappedTexels, HaveTheNormalsOfTheirMap) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(0.5f));
    test::set_normal_map(scene, material, {0.6f, 0.3f});
    // v runs along +Y in these UVs, and y of a map against v.
    test::add_quad(scene, material, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    const Mapped mapped(scene);
    const glm::vec3 stored = test::stored_normal({0.6f, 0.3f});
    ASSERT_EQ(mapped.normals.size(), kMappedNormals * mapped.own.size());
    ASSERT_FALSE(mapped.own.empty());
    for (const glm::vec3& normal : mapped.normals)
        ASSERT_LT(glm::distance(normal, {stored.x, -stored.y, stored.z}), 1e-5f);
}

TEST(MappedTexels, WithoutAMapHaveTheirOwnNormal) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 1.0f);
    Material material = test::diffuse(glm::vec3(0.5f));
    test::set_normal_map(scene, material, {0.6f, 0.3f});
    test::add_floor(scene, material, 1.0f, 3.0f);
    const Mapped mapped(scene);
    // Both floors have equally many texels, and the first one has no map.
    for (size_t i = 0; i < mapped.own.size(); ++i) {
        for (size_t k = 0; k < kMappedNormals; ++k) {
            const glm::vec3& normal = mapped.normals[kMappedNormals * i + k];
            EXPECT_EQ(normal == mapped.own[i], i < mapped.own.size() / 2) << i;
        }
    }
}

}  // namespace
}  // namespace tetralight
