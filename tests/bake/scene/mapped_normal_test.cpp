// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/mapped_normal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// (x, y) of a normal as a texel; blue says nothing.
std::array<uint8_t, 4> texel_of(float x, float y) {
    const auto code = [](float value) {
        return static_cast<uint8_t>(std::lround(127.5f * (value + 1.0f)));
    };
    return {code(x), code(y), 0, 255};
}

/// A square in the plane z = 0 that faces +Z. u runs along +X and v along −Y, as in an image that
/// hangs upright. Its normal map is one texel.
struct Mapped {
    Scene scene;

    explicit Mapped(float x, float y) {
        scene.normal_maps.push_back({"map", Image8{1, 1, {texel_of(x, y)}}});
        Material material;
        material.normal_texture.texture = 0;
        test::add_quad(scene, material, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        for (glm::vec2& uv : mesh().uvs[0]) uv.y = 1.0f - uv.y;
    }

    Mesh& mesh() { return scene.meshes[0]; }

    Material& material() { return scene.materials[0]; }

    /// The mapped normal of an instance, in a place of each triangle; they have to agree.
    glm::vec3 normal(const glm::mat3& world_from_mesh = glm::mat3(1.0f),
                     const glm::vec3& base_normal = {0.0f, 0.0f, 1.0f}) {
        const auto of = [&](uint32_t triangle) {
            return mapped_normal(scene, mesh_point(mesh(), triangle, {0.3f, 0.2f}), world_from_mesh,
                                 base_normal);
        };
        EXPECT_LT(glm::distance(of(0), of(1)), 1e-5f);
        return of(0);
    }
};

void expect_near(const glm::vec3& actual, const glm::vec3& expected) {
    // Half a step of 8 bits, for a z that is not small.
    EXPECT_LT(glm::distance(actual, expected), 0.006f)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

const glm::vec3 kTilted(0.6f, 0.48f, 0.64f);

TEST(MappedNormal, OfAFlatMapIsTheBaseNormal) {
    expect_near(Mapped(0.0f, 0.0f).normal(), {0.0f, 0.0f, 1.0f});
}

TEST(MappedNormal, HasXAlongUAndYAgainstV) {
    expect_near(Mapped(kTilted.x, kTilted.y).normal(), kTilted);
}

TEST(MappedNormal, MakesZFromRedAndGreen) {
    Mapped mapped(kTilted.x, kTilted.y);
    const glm::vec3 expected = mapped.normal();
    mapped.scene.normal_maps[0].image.pixels[0][2] = 77;
    EXPECT_EQ(mapped.normal(), expected);
    // Longer than 1: z = 0.
    expect_near(Mapped(1.0f, 1.0f).normal(), glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f)));
}

TEST(MappedNormal, ScalesXAndY) {
    Mapped mapped(kTilted.x, kTilted.y);
    mapped.material().normal_scale = 0.5f;
    expect_near(mapped.normal(), glm::normalize(kTilted * glm::vec3(0.5f, 0.5f, 1.0f)));
    mapped.material().normal_scale = 0.0f;
    EXPECT_EQ(mapped.normal(), glm::vec3(0.0f, 0.0f, 1.0f));
}

TEST(MappedNormal, TurnsWithTheUvs) {
    Mapped mapped(kTilted.x, kTilted.y);
    // u along +Y, v along +X: the image is turned by a quarter to the left.
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec3& position = mapped.mesh().positions[i];
        mapped.mesh().uvs[0][i] = {position.y, position.x};
    }
    expect_near(mapped.normal(), {-kTilted.y, kTilted.x, kTilted.z});
}

TEST(MappedNormal, IsMirroredWithTheUvs) {
    Mapped mapped(kTilted.x, kTilted.y);
    for (glm::vec2& uv : mapped.mesh().uvs[0]) uv.x = -uv.x;
    expect_near(mapped.normal(), {-kTilted.x, kTilted.y, kTilted.z});
}

TEST(MappedNormal, TurnsWithTheTextureTransform) {
    Mapped mapped(kTilted.x, kTilted.y);
    // image (u, v) = mesh (−v, u): u of the image runs along +Y, v along +X.
    mapped.material().normal_texture.image_from_mesh =
        glm::mat3(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1));
    expect_near(mapped.normal(), {-kTilted.y, kTilted.x, kTilted.z});
    // The tangents of the mesh are those of its own UVs.
    mapped.mesh().tangents.assign(4, {1, 0, 0, 1});
    expect_near(mapped.normal(), {-kTilted.y, kTilted.x, kTilted.z});
}

TEST(MappedNormal, FollowsTangents) {
    Mapped mapped(kTilted.x, kTilted.y);
    mapped.mesh().tangents.assign(4, {0, 3, 0, 1});
    expect_near(mapped.normal(), {-kTilted.y, kTilted.x, kTilted.z});
    mapped.mesh().tangents.assign(4, {0, 3, 0, -1});
    expect_near(mapped.normal(), {kTilted.y, kTilted.x, kTilted.z});
    // Perpendicular to the normal only after a correction.
    mapped.mesh().tangents.assign(4, {1, 0, 5, 1});
    expect_near(mapped.normal(), kTilted);
}

TEST(MappedNormal, OfAMirroredInstanceIsMirrored) {
    const glm::mat3 mirror(glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1));
    Mapped mapped(kTilted.x, kTilted.y);
    expect_near(mapped.normal(mirror), {-kTilted.x, kTilted.y, kTilted.z});
    mapped.mesh().tangents.assign(4, {1, 0, 0, 1});
    expect_near(mapped.normal(mirror), {-kTilted.x, kTilted.y, kTilted.z});
}

TEST(MappedNormal, TurnsWithTheInstance) {
    const glm::mat3 turned(glm::rotate(glm::mat4(1.0f), 1.1f, glm::vec3(0.6f, 0.0f, 0.8f)));
    Mapped mapped(kTilted.x, kTilted.y);
    expect_near(mapped.normal(turned, turned[2]), turned * kTilted);
    mapped.mesh().tangents.assign(4, {1, 0, 0, 1});
    expect_near(mapped.normal(turned, turned[2]), turned * kTilted);
}

TEST(MappedNormal, StaysUnitUnderNonUniformScale) {
    // The square's own axes keep their directions.
    const glm::mat3 scale(glm::vec3(5, 0, 0), glm::vec3(0, 0.1f, 0), glm::vec3(0, 0, 2));
    Mapped mapped(kTilted.x, kTilted.y);
    expect_near(mapped.normal(scale), kTilted);
    EXPECT_NEAR(glm::length(mapped.normal(scale)), 1.0f, 1e-6f);
}

TEST(MappedNormal, IsAboutTheVertexNormal) {
    const glm::vec3 base = glm::normalize(glm::vec3(0.0f, 1.0f, 2.0f));
    expect_near(Mapped(0.0f, 0.0f).normal(glm::mat3(1.0f), base), base);
    const glm::vec3 tilted = Mapped(0.6f, 0.0f).normal(glm::mat3(1.0f), base);
    expect_near(tilted, 0.6f * glm::vec3(1, 0, 0) + 0.8f * base);
}

TEST(MappedNormal, OfDegenerateTangentSpaceIsTheBaseNormal) {
    const glm::vec3 base(0.0f, 0.0f, 1.0f);
    Mapped mapped(kTilted.x, kTilted.y);
    for (glm::vec2& uv : mapped.mesh().uvs[0]) uv.y = uv.x;  // a line
    EXPECT_EQ(mapped.normal(), base);
    mapped.mesh().uvs[0].assign(4, glm::vec2(0.5f));
    EXPECT_EQ(mapped.normal(), base);
    mapped.mesh().tangents.assign(4, {0, 0, 1, 1});  // along the normal
    EXPECT_EQ(mapped.normal(), base);
    mapped.mesh().uvs[0].clear();
    EXPECT_EQ(mapped.normal(), base);
}

}  // namespace
}  // namespace tetralight
