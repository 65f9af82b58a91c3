// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/lightmap_texels.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const Material kGrey = test::diffuse(glm::vec3(0.5f));

/// The texels of a scene at 10 a metre.
struct Texels {
    LightmapLayout layout;
    std::vector<TexelMap> maps;
    LightmapTexels texels;
    glm::dvec3 center{0.0};

    explicit Texels(const Scene& scene, const LightmapTexelSettings& settings = {}) {
        layout = *make_lightmap_layout(scene, {});
        maps = make_texel_maps(scene, layout, settings);
        const auto traced = TraceScene::make_static(scene);
        texels = *make_lightmap_texels(scene, *traced, layout, maps, settings);
    }

    [[nodiscard]] std::vector<glm::dvec3> origins(size_t texel) const {
        std::vector<glm::dvec3> all;
        for (const glm::vec3& offset : texels.view()[texel].origins)
            all.push_back(texels.positions[texel] + glm::dvec3(offset));
        return all;
    }

    /// The range of an instance's texels.
    [[nodiscard]] std::pair<size_t, size_t> range(size_t instance) const {
        return {texels.first_texel[instance], texels.first_texel[instance + 1]};
    }
};

TEST(LightmapTexels, AFreeFloorIsValidAndLooksUp) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f, 3.0f);
    const Texels baked(scene);
    ASSERT_GE(baked.texels.positions.size(), 400u);
    for (size_t i = 0; i < baked.texels.positions.size(); ++i) {
        EXPECT_EQ(baked.texels.validity[i], 1.0f);
        EXPECT_EQ(baked.texels.positions[i].y, 3.0);
        EXPECT_EQ(baked.texels.surfaces[i].normal, glm::vec3(0, 1, 0));
        ASSERT_TRUE(baked.texels.is_valid(i));
        for (const glm::dvec3& origin : baked.origins(i)) {
            EXPECT_GT(origin.y, 3.0);
            EXPECT_LT(origin.y, 3.001);
        }
    }
}

TEST(LightmapTexels, MirroredInstancesLookUpToo) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f).world_from_mesh =
        glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const Texels baked(scene);
    for (size_t i = 0; i < baked.texels.positions.size(); ++i) {
        EXPECT_EQ(baked.texels.surfaces[i].normal, glm::vec3(0, 1, 0));
        EXPECT_EQ(baked.texels.validity[i], 1.0f);
    }
}

/// A floor with a box that is sunk in it.
Scene floor_with_box() {
    Scene scene;
    test::add_floor(scene, kGrey, 2.0f);
    test::add_box(scene, kGrey, test::Facing::Outward, {-0.53f, -0.5f, -0.53f}, {0.53f, 1, 0.53f});
    return scene;
}

TEST(LightmapTexels, TexelsUnderABoxAreInvalidAndOthersAreSampledOutsideOfIt) {
    const Texels baked(floor_with_box());
    const auto [begin, end] = baked.range(0);
    size_t invalid = 0;
    for (size_t i = begin; i < end; ++i) {
        invalid += !baked.texels.is_valid(i);
        for (const glm::dvec3& origin : baked.origins(i)) {
            EXPECT_GT(std::max(std::abs(origin.x), std::abs(origin.z)), 0.53);
        }
    }
    // Of 10.6² texels under the box those at its border are partly outside, or are pushed out.
    EXPECT_GE(invalid, 8u * 8u);
    EXPECT_LE(invalid, 11u * 11u);
}

TEST(LightmapTexels, SunkPartsOfABoxAreInvalid) {
    const Texels baked(floor_with_box());
    const auto [begin, end] = baked.range(1);
    for (size_t i = begin; i < end; ++i) {
        const glm::dvec3& p = baked.texels.positions[i];
        // Below the floor, away from its border, nothing but the back of the floor is above.
        if (p.y > 0.0) {
            EXPECT_TRUE(baked.texels.is_valid(i)) << p.y;
        }
        for (const glm::dvec3& origin : baked.origins(i)) {
            if (p.y > -0.05) {
                EXPECT_GT(origin.y, -0.05);
            }
        }
    }
}

TEST(LightmapTexels, HalfBuriedTexelsTakeTheSideThatSeesFewerBacks) {
    // Below a double-sided floor half of the rays hit its back, which is too few for geometry.
    Material two_sided = kGrey;
    two_sided.is_double_sided = true;
    size_t half_buried = 0;
    for (const float low : {-0.50f, -0.52f, -0.54f, -0.56f, -0.58f}) {
        Scene scene;
        test::add_floor(scene, two_sided, 2.0f);
        test::add_box(scene, kGrey, test::Facing::Outward, {-0.5f, low, -0.5f}, {0.5f, 1, 0.5f});
        const Texels baked(scene);
        const auto [begin, end] = baked.range(1);
        for (size_t i = begin; i < end; ++i) {
            // Places are 0.025 m above and below the middle.
            if (std::abs(baked.texels.positions[i].y) > 0.02) continue;
            ++half_buried;
            ASSERT_TRUE(baked.texels.is_valid(i));
            for (const glm::dvec3& origin : baked.origins(i)) EXPECT_GT(origin.y, 0.0);
        }
    }
    EXPECT_GE(half_buried, 4u * 10u);
}

TEST(LightmapTexels, APaneBoundsNoGeometry) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f);
    Material pane = kGrey;
    pane.base_color.a = 0.9f;
    pane.alpha_mode = AlphaMode::Blend;
    test::add_floor(scene, pane, 5.0f, 0.1f);
    const Texels baked(scene);
    const auto [begin, end] = baked.range(0);
    for (size_t i = begin; i < end; ++i) EXPECT_EQ(baked.texels.validity[i], 1.0f);
    scene.materials[1].alpha_mode = AlphaMode::Opaque;
    const Texels shut(scene);
    for (size_t i = begin; i < end; ++i) EXPECT_FALSE(shut.texels.is_valid(i));
}

TEST(LightmapTexels, AWallWithoutThicknessSharesNoTexel) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f);
    Material two_sided = kGrey;
    two_sided.is_double_sided = true;
    test::add_quad(scene, two_sided, {0.033f, 0, -1}, {0, 0, 2}, {0, 1, 0});
    const Texels baked(scene);
    const auto [begin, end] = baked.range(0);
    for (size_t i = begin; i < end; ++i) {
        const auto origins = baked.origins(i);
        ASSERT_FALSE(origins.empty());
        for (const glm::dvec3& origin : origins) EXPECT_EQ(origin.x > 0.033, origins[0].x > 0.033);
    }
}

/// A sphere of radius 1 with `count` meridians.
Mesh sphere(int count) {
    Mesh mesh;
    const int rings = count / 2;
    for (int ring = 0; ring <= rings; ++ring) {
        for (int i = 0; i <= count; ++i) {
            const double polar = std::numbers::pi * ring / rings;
            const double turn = 2.0 * std::numbers::pi * (i % count) / count;
            const glm::dvec3 p(std::sin(polar) * std::sin(turn), std::cos(polar),
                               std::sin(polar) * std::cos(turn));
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(p);
        }
    }
    const auto at = [&](int ring, int i) { return static_cast<uint32_t>(ring * (count + 1) + i); };
    for (int ring = 0; ring < rings; ++ring) {
        for (int i = 0; i < count; ++i) {
            for (const uint32_t k : {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)})
                mesh.indices.push_back(k);
            for (const uint32_t k : {at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)})
                mesh.indices.push_back(k);
        }
    }
    return mesh;
}

TEST(LightmapTexels, SmoothNormalsRaiseOriginsTowardsTheCurvedSurface) {
    Scene scene;
    test::add_mesh(scene, kGrey, sphere(16));
    const Texels baked(scene);
    double nearest = 2.0, farthest = 0.0, flattest = 2.0;
    for (size_t i = 0; i < baked.texels.positions.size(); ++i) {
        const glm::dvec3& position = baked.texels.positions[i];
        EXPECT_GT(glm::dot(glm::dvec3(baked.texels.surfaces[i].normal), glm::normalize(position)),
                  0.99);
        flattest = std::min(flattest, glm::length(position));
        for (const glm::dvec3& origin : baked.origins(i)) {
            nearest = std::min(nearest, glm::length(origin));
            farthest = std::max(farthest, glm::length(origin));
        }
    }
    EXPECT_LT(flattest, 0.97);  // facets: cos(π / 16)²
    EXPECT_GT(nearest, flattest + 0.01);
    EXPECT_LT(farthest, 1.04);
}

TEST(LightmapTexels, LeavesThatFaceEachOtherAreValid) {
    Scene scene;
    test::add_quad(scene, kGrey, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
    test::add_quad(scene, kGrey, {0, 1, -1}, {1, 0, 0}, {0, 0, 1});
    const Texels baked(scene);
    for (size_t i = 0; i < baked.texels.positions.size(); ++i)
        EXPECT_TRUE(baked.texels.is_valid(i)) << i;
}

TEST(LightmapTexels, ThreadsAndOtherObjectsChangeNoTexel) {
    Scene scene = floor_with_box();
    const Texels one(scene, {.thread_count = 1});
    test::add_box(scene, kGrey, test::Facing::Outward, {9, 0, 9}, {10, 1, 10});
    // Far enough away that no ray that tells inside from outside changes its answer.
    const Texels three(scene, {.thread_count = 3});
    const size_t count = one.texels.positions.size();
    for (size_t i = 0; i < count; ++i) {
        ASSERT_EQ(one.texels.positions[i], three.texels.positions[i]);
        ASSERT_EQ(one.texels.surfaces[i].normal, three.texels.surfaces[i].normal);
        ASSERT_EQ(one.texels.is_valid(i), three.texels.is_valid(i));
    }
}

}  // namespace
}  // namespace tetralight
