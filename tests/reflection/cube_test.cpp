// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/cube.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

float angle_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// OpenGL 4.6, table 8.19, line by line: s and t from sc, tc and ma.
CubePlace place_of_table(const glm::vec3& r) {
    const glm::vec3 a = glm::abs(r);
    const auto place = [](uint32_t face, float sc, float tc, float ma) {
        return CubePlace{face, 0.5f * (glm::vec2(sc, tc) / std::abs(ma) + 1.0f)};
    };
    if (a.x > a.y && a.x > a.z) {
        return r.x > 0 ? place(0, -r.z, -r.y, r.x) : place(1, r.z, -r.y, r.x);
    }
    if (a.y > a.z) return r.y > 0 ? place(2, r.x, r.z, r.y) : place(3, r.x, -r.z, r.y);
    return r.z > 0 ? place(4, r.x, -r.y, r.z) : place(5, -r.x, -r.y, r.z);
}

TEST(Cube, FacesAreThoseOfOpenGl) {
    std::mt19937 random(1);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 direction = 3.0f * test::random_unit_vector(random);
        const CubePlace place = cube_place(direction), expected = place_of_table(direction);
        ASSERT_EQ(place.face, expected.face);
        ASSERT_LT(glm::distance(place.uv, expected.uv), 1e-6f);
    }
}

TEST(Cube, DirectionsAndPlacesAreInverse) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0.001f, 0.999f);
    for (int i = 0; i < 10'000; ++i) {
        const CubePlace place{static_cast<uint32_t>(i) % kCubeFaceCount,
                              {unit(random), unit(random)}};
        const glm::vec3 direction = cube_direction(place);
        ASSERT_NEAR(glm::length(direction), 1.0f, 1e-6f);
        const CubePlace again = cube_place(0.1f * direction);
        ASSERT_EQ(again.face, place.face);
        ASSERT_LT(glm::distance(again.uv, place.uv), 1e-6f);
    }
}

TEST(Cube, PlacesBeyondAFaceContinueItsPlane) {
    // A texel beyond the right edge of +X, which ends at z = -1.
    const glm::vec3 direction = cube_direction(CubePlace{0, {1.25f, 0.5f}});
    EXPECT_LT(glm::distance(direction, glm::normalize(glm::vec3(1.0f, 0.0f, -1.5f))), 1e-6f);
}

TEST(Cube, EveryDirectionHasAPlaceOnAFace) {
    const float nan = std::nanf(""), infinity = HUGE_VALF;
    for (const float x : {0.0f, -0.0f, 1e-45f, 1.0f, -3e38f, infinity, nan}) {
        for (const float y : {0.0f, -1e-45f, 3e38f, -infinity, nan}) {
            const CubePlace place = cube_place({x, y, x});
            EXPECT_LT(place.face, kCubeFaceCount);
            EXPECT_TRUE(place.uv.x >= 0.0f && place.uv.x <= 1.0f);
            EXPECT_TRUE(place.uv.y >= 0.0f && place.uv.y <= 1.0f);
        }
    }
    EXPECT_EQ(cube_place(glm::vec3(0.0f)).face, 0u);
}

TEST(Cube, SolidAnglesAddUpToTheSphere) {
    for (const uint32_t size : {1u, 2u, 5u, 64u}) {
        double sum = 0.0;
        for (uint32_t y = 0; y < size; ++y) {
            for (uint32_t x = 0; x < size; ++x) sum += cube_solid_angle(x, y, size);
        }
        EXPECT_NEAR(6.0 * sum, 4.0 * std::numbers::pi, 1e-11) << size;
    }
}

TEST(Cube, SolidAnglesAreThoseOfAQuadrature) {
    constexpr uint32_t kSize = 4, kX = 0, kY = 2;
    constexpr int kSteps = 1000;
    double sum = 0.0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double u = 2.0 * (kX + (i % kSteps + 0.5) / kSteps) / kSize - 1.0;
        const double v = 2.0 * (kY + (i / kSteps + 0.5) / kSteps) / kSize - 1.0;
        sum += std::pow(1.0 + u * u + v * v, -1.5);
    }
    const double step = 2.0 / (kSize * kSteps);
    EXPECT_NEAR(cube_solid_angle(kX, kY, kSize), sum * step * step, 1e-7);
}

/// Calls visit(face, x, y beyond one edge, x, y of the texel inside that edge).
template <class Visit>
void for_each_edge_texel(uint32_t size, Visit visit) {
    const int n = static_cast<int>(size);
    for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
        for (int i = 0; i < n; ++i) {
            visit(face, glm::ivec2(-1, i), glm::ivec2(0, i));
            visit(face, glm::ivec2(n, i), glm::ivec2(n - 1, i));
            visit(face, glm::ivec2(i, -1), glm::ivec2(i, 0));
            visit(face, glm::ivec2(i, n), glm::ivec2(i, n - 1));
        }
    }
}

CubeTexel texel_at(uint32_t face, const glm::ivec2& place) {
    return {face, static_cast<uint32_t>(place.x), static_cast<uint32_t>(place.y)};
}

TEST(WrappedTexel, LiesBesideTheTexelAcrossTheEdge) {
    for (const uint32_t size : {1u, 2u, 3u, 8u, 33u}) {
        // At the middle of an edge a texel is (2 / size) / 2 wide, and narrower elsewhere.
        const float width = 1.0f / static_cast<float>(size);
        for_each_edge_texel(size, [&](uint32_t face, glm::ivec2 beyond, glm::ivec2 inside) {
            const CubeTexel across = wrapped_texel(face, beyond.x, beyond.y, size);
            ASSERT_NE(across.face, face);
            ASSERT_LT(across.x, size);
            ASSERT_LT(across.y, size);
            const float angle = angle_between(cube_direction(across, size),
                                              cube_direction(texel_at(face, inside), size));
            ASSERT_LE(angle, 1.6f * width) << size;
        });
    }
}

TEST(WrappedTexel, LeadsBackAcrossTheSameEdge) {
    for (const uint32_t size : {1u, 2u, 3u, 8u, 33u}) {
        for_each_edge_texel(size, [&](uint32_t face, glm::ivec2 beyond, glm::ivec2 inside) {
            const CubeTexel across = wrapped_texel(face, beyond.x, beyond.y, size);
            const int x = static_cast<int>(across.x), y = static_cast<int>(across.y);
            const std::array back{wrapped_texel(across.face, x - 1, y, size),
                                  wrapped_texel(across.face, x + 1, y, size),
                                  wrapped_texel(across.face, x, y - 1, size),
                                  wrapped_texel(across.face, x, y + 1, size)};
            ASSERT_EQ(std::ranges::count(back, texel_at(face, inside)), 1);
        });
    }
}

TEST(WrappedTexel, InsideIsTheTexelItself) {
    for (int i = 0; i < 6 * 4 * 4; ++i) {
        const auto face = static_cast<uint32_t>(i / 16);
        const glm::ivec2 place(i % 4, i / 4 % 4);
        EXPECT_EQ(wrapped_texel(face, place.x, place.y, 4), texel_at(face, place));
    }
}

TEST(WrappedTexel, BeyondACornerIsATexelBesideTheCorner) {
    for (const int n : {1, 2, 8}) {
        const auto size = static_cast<uint32_t>(n);
        for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
            for (const int x : {-1, n}) {
                for (const int y : {-1, n}) {
                    const std::array beside{wrapped_texel(face, x, std::clamp(y, 0, n - 1), size),
                                            wrapped_texel(face, std::clamp(x, 0, n - 1), y, size)};
                    EXPECT_EQ(std::ranges::count(beside, wrapped_texel(face, x, y, size)), 1);
                }
            }
        }
    }
}

}  // namespace
}  // namespace tetralight
