// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <span>
#include <vector>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

// Whole bakes of scenes whose light has a closed form.
//
// A probe keeps bands 0 to 2, so that E(n) of a small source is only approximate. Two things are
// exact nevertheless: each coefficient L_i, and the irradiance of any surface above whose horizon
// all light lies, E(n) = ∫ L(ω) (n·ω) dω, which is n times the vector (L3, L1, L2) / 0.488603.

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBand0 = 0.28209479177387814;
constexpr double kBand1 = 0.48860251190291992;

/// Light that arrives at one position.
RadianceSh bake(const Scene& scene, const glm::dvec3& position, uint32_t sample_count,
                uint32_t bounces, uint64_t seed = 0) {
    BakeSettings settings;
    settings.seed = seed;
    settings.sample_count = sample_count;
    settings.bounces = bounces;
    const auto baked = bake_probes(scene, std::span(&position, 1), settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return baked->radiance[0];
}

/// Irradiance (red) of a surface above whose horizon all light lies.
double exact_irradiance(const RadianceSh& light, const glm::dvec3& normal) {
    const auto& c = light.coefficients;
    return glm::dot(normal, glm::dvec3(c[3].x, c[1].x, c[2].x)) / kBand1;
}

glm::vec3 irradiance(const RadianceSh& light, glm::vec3 normal) {
    return evaluate_irradiance(irradiance_from_radiance(light), normal);
}

void expect_equal_light(const RadianceSh& actual, const RadianceSh& expected, float tolerance) {
    for (int i = 0; i < kShCoefficientCount; ++i) {
        EXPECT_LT(glm::distance(actual.coefficients[i], expected.coefficients[i]), tolerance) << i;
    }
}

// --- Sky -----------------------------------------------------------------------------------------

TEST(LightTransport, ConstantSkyGivesIrradiancePiForEveryNormal) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    const RadianceSh light = bake(scene, {1, 2, 3}, 8192, 4);
    std::mt19937_64 engine(1);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_NEAR(irradiance(light, test::random_direction(engine)).y, kPi, 1e-3);
    }
}

/// The direction from which most light comes, of a black sky of 9 x 5 texels with one coloured.
glm::vec3 main_direction(uint32_t column, uint32_t row, float rotation = 0.0f) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    scene.environment.rotation_radians = rotation;
    scene.environment.image = {9, 5, std::vector<glm::vec3>(45, glm::vec3(0.0f))};
    scene.environment.image.pixels[row * 9 + column] = {1, 0, 0};
    const auto c = bake(scene, {0, 0, 0}, 4096, 0).coefficients;
    EXPECT_EQ(c[0].y, 0.0f);  // it keeps its colour
    return glm::normalize(glm::vec3(c[3].x, c[1].x, c[2].x));
}

TEST(LightTransport, SkyTexelsLightTheRightSide) {
    // Texel (4, 2) is centred on +X. Columns 6 and 2 are centred at azimuths of ±80° (0.2222 of a
    // turn from the centre), so that their cosine to ±Z is 0.98. Row 0 is centred 18° off the pole,
    // and filtering spreads it to 54°, where cosines are 0.95 and 0.59.
    EXPECT_GT(main_direction(4, 2).x, 0.99f);
    EXPECT_GT(main_direction(6, 2).z, 0.97f);
    EXPECT_LT(main_direction(2, 2).z, -0.97f);
    EXPECT_GT(main_direction(4, 0).y, 0.8f);
    EXPECT_LT(main_direction(4, 4).y, -0.8f);
}

TEST(LightTransport, SkyRotationTurnsTheLight) {
    EXPECT_LT(main_direction(4, 2, static_cast<float>(kPi / 2)).z, -0.99f);
}

TEST(LightTransport, AmbientIsWhatAProbeInTheOpenSees) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    scene.environment.rotation_radians = 0.4f;
    scene.environment.image = {8, 4, {}};
    for (int i = 0; i < 32; ++i) {
        scene.environment.image.pixels.emplace_back(i % 3, i % 5, i % 7);
    }
    const glm::dvec3 position(0.0);
    BakeSettings settings;
    settings.sample_count = 1 << 16;
    const auto baked = bake_probes(scene, std::span(&position, 1), settings);
    ASSERT_TRUE(baked);
    expect_equal_light(baked->ambient, baked->radiance[0], 0.01f);
}

// --- Closed furnace ------------------------------------------------------------------------------

/// Mean irradiance of many short bakes, and its standard error.
struct MeanIrradiance {
    double mean = 0.0;
    double error = 0.0;
};

MeanIrradiance mean_irradiance(std::span<const RadianceSh> bakes, glm::vec3 normal) {
    double sum = 0.0, squares = 0.0;
    for (const RadianceSh& light : bakes) {
        const double value = irradiance(light, normal).x;
        sum += value;
        squares += value * value;
    }
    const auto count = static_cast<double>(bakes.size());
    const double mean = sum / count;
    const double variance = std::max(0.0, squares / count - mean * mean);
    return {mean, std::sqrt(variance / (count - 1.0))};
}

TEST(LightTransport, FurnaceSumsTheGeometricSeries) {
    // Everything has radiance e + ρ e + ... + ρ^b e, in every direction.
    for (const double albedo : {0.5, 0.8}) {
        for (const uint32_t bounces : {0u, 4u, 24u}) {
            Scene scene;
            test::add_box(scene,
                          test::diffuse(glm::vec3(static_cast<float>(albedo)), glm::vec3(2.0f)),
                          test::Facing::Inward, {-1, -2, -1}, {3, 1, 1});
            const double radiance = 2.0 * (1.0 - std::pow(albedo, bounces + 1)) / (1.0 - albedo);
            for (const glm::dvec3& p : {glm::dvec3(1, 0, 0), glm::dvec3(2.999, 0.99, -0.999)}) {
                std::vector<RadianceSh> bakes;
                for (uint64_t seed = 0; seed < 64; ++seed) {
                    bakes.push_back(bake(scene, p, 256, bounces, seed));
                }
                for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
                    const MeanIrradiance light = mean_irradiance(bakes, n);
                    const double expected = kPi * radiance;
                    EXPECT_NEAR(light.mean, expected, 3.0 * light.error + 1e-5 * expected);
                    EXPECT_LT(light.error, 0.01 * expected);
                }
            }
        }
    }
}

TEST(LightTransport, FurnaceOfFineTexelsHasTheLightOfTheirMean) {
    // Three texels in four have the albedo 0.96, one reflects nothing: a mean of 0.72.
    Scene scene;
    Texture texture{"texels", Image8{256, 256, {}}};
    for (int i = 0; i < 256 * 256; ++i) {
        const uint8_t code = i % 2 == 0 && i / 256 % 2 == 0 ? 0 : 255;
        texture.image.pixels.push_back({code, code, code, 255});
    }
    scene.textures.push_back(std::move(texture));
    Material material = test::diffuse(glm::vec3(0.96f), glm::vec3(2.0f));
    material.base_color_texture.texture = 0;
    test::add_box(scene, material, test::Facing::Inward, {-1, -2, -1}, {3, 1, 1});
    for (const uint32_t bounces : {1u, 4u}) {
        const double radiance = 2.0 * (1.0 - std::pow(0.72, bounces + 1)) / (1.0 - 0.72);
        std::vector<RadianceSh> bakes;
        for (uint64_t seed = 0; seed < 64; ++seed) {
            bakes.push_back(bake(scene, {1, 0, 0}, 256, bounces, seed));
        }
        const MeanIrradiance light = mean_irradiance(bakes, {0, 1, 0});
        EXPECT_NEAR(light.mean, kPi * radiance, 3.0 * light.error + 1e-3 * kPi * radiance);
        EXPECT_LT(light.error, 0.01 * kPi * radiance);
    }
}

// --- Emissive surfaces ---------------------------------------------------------------------------

/// Light at the origin from a rectangle of radiance 1: ∫ Y_i cos θ / r² dA by the midpoint rule.
RadianceSh rectangle_light(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
    constexpr int kSteps = 300;
    const glm::dvec3 area_vector = glm::cross(u, v) / double{kSteps * kSteps};
    RadianceShSum sum;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::dvec3 p =
            corner + (i % kSteps + 0.5) / kSteps * u + (i / kSteps + 0.5) / kSteps * v;
        const double r = glm::length(p);
        const double solid_angle = -glm::dot(area_vector, p) / (r * r * r);
        sum.add(glm::vec3(p / r), glm::vec3(glm::dvec3(solid_angle)));
    }
    return radiance_from_sum(sum, 1.0);
}

/// The same by a bake.
RadianceSh baked_rectangle(glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Scene scene;
    test::add_quad(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), corner, u, v);
    return bake(scene, {0, 0, 0}, 1 << 17, 0);
}

TEST(LightTransport, RectangleHasTheCoefficientsOfItsSolidAngle) {
    const glm::vec3 corner(-0.5f, 1.0f, 0.3f), u(1.5f, 0.2f, 0.0f), v(0.1f, 0.4f, 1.2f);
    const RadianceSh expected = rectangle_light(corner, u, v);
    // 1 % of the largest coefficient, L0.
    expect_equal_light(baked_rectangle(corner, u, v), expected, 0.01f * expected.coefficients[0].x);
}

TEST(LightTransport, ParallelRectangleHasItsFormFactor) {
    // Element under the corner of an a x b rectangle at distance c, A = a/c, B = b/c (Howell, "A
    // Catalog of Radiation Heat Transfer Configuration Factors", B-3):
    // F = 1/2π (A/√(1+A²) atan(B/√(1+A²)) + B/√(1+B²) atan(A/√(1+B²))), and E = π F.
    const double a = 1.5, b = 0.8;
    const double sa = std::sqrt(1 + a * a), sb = std::sqrt(1 + b * b);
    const double expected = 0.5 * (a / sa * std::atan(b / sa) + b / sb * std::atan(a / sb));
    const RadianceSh light = baked_rectangle({0, 1, 0}, {1.5f, 0, 0}, {0, 0, 0.8f});
    EXPECT_NEAR(exact_irradiance(light, {0, 1, 0}), expected, 0.01 * expected);
}

TEST(LightTransport, PerpendicularRectangleHasItsFormFactor) {
    // Element at distance c from the foot of a rectangle of height a and width b that stands on the
    // element's horizon, opposite its corner, X = a/b, Y = c/b (Howell, B-4):
    // F = 1/2π (atan(1/Y) − Y/√(X²+Y²) atan(1/√(X²+Y²))), and E = π F.
    const double x = 1.2 / 0.9, y = 1.0 / 0.9;
    const double s = std::sqrt(x * x + y * y);
    const double expected = 0.5 * (std::atan(1.0 / y) - y / s * std::atan(1.0 / s));
    const RadianceSh light = baked_rectangle({1, 0, 0}, {0, 0, 0.9f}, {0, 1.2f, 0});
    EXPECT_NEAR(exact_irradiance(light, {0, 1, 0}), expected, 0.01 * expected);
}

TEST(LightTransport, HalfOfAllDirectionsGivesExactIrradiance) {
    // Light from a whole hemisphere has no even band above 0, and odd bands above 1 do not count
    // for irradiance: three bands give E(n) = π/2 (1 + cos) exactly. The ceiling leaves out a ring
    // of 1/1000 of the hemisphere, 2π · 1e-3 sr; weighted by 17/16 at most, the peak of the
    // truncated kernel, it is less than 0.007 < 1 % of π/2.
    Scene scene;
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f)), 1000.0f, 1.0f);
    const RadianceSh light = bake(scene, {0, 0, 0}, 1 << 14, 0);
    for (const double cosine : {1.0, 0.6, 0.0}) {
        const glm::vec3 normal(std::sqrt(1.0 - cosine * cosine), cosine, 0.0);
        EXPECT_NEAR(irradiance(light, normal).x, kPi / 2 * (1.0 + cosine), 0.01 * kPi / 2);
    }
}

// --- Punctual lights -----------------------------------------------------------------------------

Scene floor_scene(float albedo) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(albedo)), 2000.0f);
    return scene;
}

TEST(LightTransport, SunOnAFloorComesBackFromBelow) {
    // Floor radiance B = ρ/π · E cos 60°, constant over the lower hemisphere:
    // L0 = B 2π Y0, L1 = −B π 0.4886, and no other band up to 2.
    Scene scene = floor_scene(0.5f);
    test::add_sun(scene, LightMode::Mixed, {8, 4, 2}).direction = {0.8660254f, -0.5f, 0};
    const glm::vec3 b = glm::vec3(8, 4, 2) * static_cast<float>(0.5 / kPi * 0.5);
    RadianceSh expected;
    expected.coefficients[0] = b * static_cast<float>(2 * kPi * kBand0);
    expected.coefficients[1] = b * static_cast<float>(-kPi * kBand1);
    expect_equal_light(bake(scene, {0, 1, 0}, 1 << 14, 1), expected,
                       0.01f * expected.coefficients[0].x);
}

TEST(LightTransport, PointLightOverAFloorComesBackFromBelow) {
    // Light and probe at height h over the floor. At radius r the floor has the radiance
    // ρ/π I h (r²+h²)^(-3/2); seen under cos = h (r²+h²)^(-1/2), dω = cos dA / (r²+h²):
    // ∫ L dω = 2ρIh² ∫ r (r²+h²)^(-3) dr = ρI / 2h²,
    // E(down) = 2ρIh³ ∫ r (r²+h²)^(-7/2) dr = 2ρI / 5h².
    Scene scene = floor_scene(0.5f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(10.0f), {0, 2, 0});
    const RadianceSh light = bake(scene, {0, 2, 0}, 1 << 14, 1);
    const double unit = 0.5 * 10.0 / 4.0;  // ρI / h²
    EXPECT_NEAR(light.coefficients[0].x, kBand0 * unit / 2, 0.01 * kBand0 * unit / 2);
    EXPECT_NEAR(exact_irradiance(light, {0, -1, 0}), 0.4 * unit, 0.01 * 0.4 * unit);
}

TEST(LightTransport, GroundOfAHundredKilometresDoesNotChangeTheLightAboveIt) {
    // As above, 2ρI / 5h², although rays leave the ground with an offset of a decimetre.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5e4f);
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(10.0f), {0, 2, 0});
    EXPECT_NEAR(exact_irradiance(bake(scene, {0, 2, 0}, 1 << 14, 1), {0, -1, 0}), 0.5, 0.005);
}

TEST(LightTransport, SpotLightOverAFloorComesBackFromBelow) {
    // As the point light, times the cone's ramp w(u) of the cosine u, with r²+h² = h²/u²:
    // E(down) = 2ρI/h² ∫ u⁴ w(u) du; w = 4 (u − ½)² from ½ to 1:
    // 8 [u⁷/7 − u⁶/6 + u⁵/20] = 8 · 0.0261161 = 0.2089286.
    Scene scene = floor_scene(0.5f);
    Light& spot = test::add_point_light(scene, LightMode::Mixed, glm::vec3(10.0f), {0, 2, 0});
    spot.type = LightType::Spot;
    spot.cos_inner_cone = 1.0f;
    spot.cos_outer_cone = 0.5f;
    const double expected = 0.2089286 * 0.5 * 10.0 / 4.0;
    const RadianceSh light = bake(scene, {0, 2, 0}, 1 << 14, 1);
    EXPECT_NEAR(exact_irradiance(light, {0, -1, 0}), expected, 0.01 * expected);
}

TEST(LightTransport, BakedModeAddsTheDirectLight) {
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot}) {
        Scene scene = floor_scene(0.5f);
        Light& light = test::add_light(scene, type, LightMode::Mixed, {8, 4, 2});
        light.position = {1, 4, -2};
        light.direction = glm::normalize(glm::vec3(-0.5f, -2.0f, 1.0f));
        const RadianceSh mixed = bake(scene, {0.5, 1, 0}, 256, 2);
        light.mode = LightMode::Baked;
        const RadianceSh baked = bake(scene, {0.5, 1, 0}, 256, 2);
        const Illumination arriving = illuminate(light, {0.5f, 1, 0});
        const RadianceSh direct =
            radiance_from_directional_light(arriving.to_light, arriving.irradiance);
        EXPECT_GT(direct.coefficients[0].x, 0.1f);
        expect_equal_light(baked, mixed + direct, 1e-5f);
    }
}

TEST(LightTransport, MixedLightHasNoDirectPart) {
    Scene scene;
    test::add_sun(scene, LightMode::Mixed, glm::vec3(8.0f));
    test::add_point_light(scene, LightMode::Mixed, glm::vec3(8.0f), {0, 1, 0});
    EXPECT_EQ(bake(scene, {0, 0, 0}, 64, 4), RadianceSh{});
}

TEST(LightTransport, WithoutBouncesOnlyEmissionAndSkyArrive) {
    Scene scene = floor_scene(1.0f);
    test::add_sun(scene, LightMode::Mixed, glm::vec3(8.0f));
    EXPECT_EQ(bake(scene, {0, 1, 0}, 64, 0), RadianceSh{});
}

TEST(LightTransport, RoofShadowsLightOnItsWayToFloorAndProbe) {
    for (const LightMode mode : {LightMode::Mixed, LightMode::Baked}) {
        Scene scene = floor_scene(1.0f);
        test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1e5f, 3.0f);
        test::add_point_light(scene, mode, glm::vec3(100.0f), {0, 4, 0});
        test::add_sun(scene, mode, glm::vec3(100.0f));
        EXPECT_EQ(bake(scene, {0, 1, 0}, 256, 3), RadianceSh{});
    }
}

// --- Transparency and texture --------------------------------------------------------------------

Material glass(float alpha) {
    Material material = test::diffuse(glm::vec3(0.0f));
    material.base_color.a = alpha;
    material.alpha_mode = AlphaMode::Blend;
    material.is_double_sided = true;
    return material;
}

TEST(LightTransport, BlendPanelsTransmitTheirFractionOfTheSky) {
    // A closed box of black glass: each of N rays passes one wall with probability 1 − α, so that
    // the mean radiance is 0.7 ± σ, σ = √(0.3 · 0.7 / 65536) = 0.0018; four of them.
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, glass(0.3f), test::Facing::Inward, {-1, -1, -1}, {1, 1, 1});
    const RadianceSh light = bake(scene, {0.1, 0.2, 0.3}, 65536, 4);
    EXPECT_NEAR(light.coefficients[0].x * kBand0, 0.7, 0.0072);
}

TEST(LightTransport, BlendPanelsTransmitTheirFractionOfTheSun) {
    // Sun through a panel onto a floor. Every path makes its own decision: the floor's radiance is
    // 0.4 of that in the open on average; half of 65536 rays see the floor: σ = √(0.4 · 0.6 /
    // 32768) = 0.0027.
    Scene open = floor_scene(0.5f);
    test::add_sun(open, LightMode::Mixed, glm::vec3(8.0f));
    Scene covered = open;
    test::add_floor(covered, glass(0.6f), 1e5f, 3.0f);
    const float without = bake(open, {0, 1, 0}, 65536, 1).coefficients[0].x;
    EXPECT_NEAR(bake(covered, {0, 1, 0}, 65536, 1).coefficients[0].x / without, 0.4, 0.0108);
}

TEST(LightTransport, BlendPanelsTransmitTheirFractionOfTheDirectSunOnAverage) {
    // One shadow ray a probe: 0.4 of 4096 probes are lit, σ = √(0.4 · 0.6 / 4096) = 0.0077.
    Scene scene;
    test::add_floor(scene, glass(0.6f), 10.0f, 3.0f);
    test::add_sun(scene, LightMode::Baked, glm::vec3(1.0f));
    BakeSettings settings;
    settings.sample_count = 1;
    settings.bounces = 0;
    const auto baked = bake_probes(scene, test::random_positions(4096, 1), settings);
    ASSERT_TRUE(baked);
    double sum = 0.0;
    for (const RadianceSh& light : baked->radiance) sum += light.coefficients[0].x / kBand0;
    EXPECT_NEAR(sum / 4096.0, 0.4, 0.031);
}

TEST(LightTransport, MaskPanelLetsLightThroughItsHoles) {
    // The panel's texture is open for u < 1/2, which is z < 0.
    Scene scene;
    Texture texture;
    texture.image = {2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}}};
    texture.wrap_u = TextureWrap::ClampToEdge;
    scene.textures.push_back(texture);
    Material leaf = test::diffuse(glm::vec3(0.0f));
    leaf.base_color_texture.texture = 0;
    leaf.alpha_mode = AlphaMode::Mask;
    test::add_floor(scene, leaf, 10.0f, 1.0f);
    test::add_sun(scene, LightMode::Baked, glm::vec3(1.0f));
    EXPECT_NEAR(bake(scene, {0, 0, -1}, 64, 0).coefficients[0].x, kBand0, 1e-6);
    EXPECT_EQ(bake(scene, {0, 0, 1}, 64, 0), RadianceSh{});
}

TEST(LightTransport, TexturedEmissionComesFromItsTexels) {
    // The floor's u runs along +Z: its left half is red, its right half green.
    Scene scene;
    Texture texture;
    texture.image = {2, 1, {{255, 0, 0, 255}, {0, 255, 0, 255}}};
    texture.wrap_u = TextureWrap::ClampToEdge;
    scene.textures.push_back(texture);
    Material screen = test::diffuse(glm::vec3(0.0f), glm::vec3(1.0f));
    screen.emission_texture.texture = 0;
    test::add_floor(scene, screen, 5.0f);
    const RadianceSh light = bake(scene, {0, 1, 0}, 4096, 0);
    EXPECT_GT(irradiance(light, {0, 0, -1}).x, 2.0f * irradiance(light, {0, 0, 1}).x);
    EXPECT_GT(irradiance(light, {0, 0, 1}).y, 2.0f * irradiance(light, {0, 0, -1}).y);
}

// --- Where and how large the scene is ------------------------------------------------------------

/// A room with a lit panel, a box in it and a lamp, all scaled and then moved.
Scene placed_room(double scale, const glm::dvec3& offset) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.6f)), test::Facing::Inward, {-2, 0, -2},
                  {2, 3, 2});
    test::add_box(scene, test::diffuse({0.9f, 0.2f, 0.1f}), test::Facing::Outward, {-1, 0, -1},
                  {-0.2f, 1, 0});
    test::add_ceiling(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(3.0f)), 0.8f, 2.9f);
    test::add_point_light(scene, LightMode::Baked, glm::vec3(4.0f), {1, 2, 1});
    for (MeshInstance& instance : scene.instances) {
        instance.world_from_mesh =
            glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale));
    }
    Light& light = scene.lights[0];  // 1/d²: intensity grows with the square of the scale
    light.position = glm::vec3(glm::dvec3(light.position) * scale + offset);
    light.intensity *= static_cast<float>(scale * scale);
    return scene;
}

constexpr uint32_t kRoomSamples = 1 << 14;

RadianceSh bake_room(const Scene& scene, const glm::dvec3& position) {
    return bake(scene, position, kRoomSamples, 3);
}

/// Two bakes of a room with different paths. Radiance along one path spreads by less than its mean
/// here, so that a coefficient has σ < L0 / √N and the difference of two √2 of that; four of them.
void expect_equal_but_for_noise(const RadianceSh& actual, const RadianceSh& expected) {
    const float l0 = glm::length(expected.coefficients[0]);
    expect_equal_light(actual, expected,
                       4.0f * l0 * std::sqrt(2.0f / static_cast<float>(kRoomSamples)));
}

void expect_light_of_the_room(double scale, const glm::dvec3& offset) {
    const glm::dvec3 place(0.5, 1.0, -0.5);
    expect_equal_but_for_noise(bake_room(placed_room(scale, offset), place * scale + offset),
                               bake_room(placed_room(1.0, {}), place));
}

TEST(LightTransport, IsTheSameFarFromTheOrigin) {
    expect_light_of_the_room(1.0, {1e4, -1e4, 1e4});
}

TEST(LightTransport, IsTheSameForKilometresAndMillimetres) {
    expect_light_of_the_room(1e3, {});
    expect_light_of_the_room(1e-3, {});
}

TEST(LightTransport, MirroredRoomHasTheMirroredLight) {
    Scene mirrored = placed_room(1.0, {});
    for (MeshInstance& instance : mirrored.instances) {
        instance.world_from_mesh = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    }
    mirrored.lights[0].position.x *= -1.0f;
    const RadianceSh expected = rotate(bake_room(placed_room(1.0, {}), {0.5, 1, -0.5}),
                                       glm::mat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    expect_equal_but_for_noise(bake_room(mirrored, {-0.5, 1, -0.5}), expected);
}

TEST(LightTransport, InstancesOfOneMeshAreLikeMeshesOfTheirOwn) {
    // Three solids: as meshes of their own, and as instances of one.
    Scene by_meshes = placed_room(1.0, {});
    Scene by_instances = by_meshes;
    test::add_box(by_instances, test::diffuse(glm::vec3(0.3f)), test::Facing::Outward, {0, 0, 0},
                  {0.4f, 0.4f, 0.4f});
    by_instances.instances.pop_back();
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 low(0.5f * static_cast<float>(i), 0.25f, 0.5f);
        test::add_box(by_meshes, test::diffuse(glm::vec3(0.3f)), test::Facing::Outward, low,
                      low + 0.5f);
        MeshInstance copy;
        copy.mesh = static_cast<uint32_t>(by_instances.meshes.size() - 1);
        copy.world_from_mesh = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(low)),
                                          glm::dvec3(1.25));  // 0.4 becomes 0.5
        by_instances.instances.push_back(copy);
    }
    const glm::dvec3 position(0.5, 1.5, -0.5);
    expect_equal_but_for_noise(bake_room(by_instances, position), bake_room(by_meshes, position));
}

}  // namespace
}  // namespace tetralight
