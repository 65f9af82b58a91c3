// SPDX-License-Identifier: Apache-2.0
// Alpha-blended and alpha-masked surfaces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBand1 = 0.48860251190291992;

RadianceSh bake(const Scene& scene, uint32_t bounces = 3) {
    const glm::dvec3 position(0.3, 1.0, 0.1);
    BakeSettings settings;
    settings.sample_count = 1 << 14;
    settings.bounces = bounces;
    const auto baked = bake_probes(scene, std::span(&position, 1), settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return baked->radiance[0];
}

/// A very large ground with an alpha mode and an alpha.
Scene ground(AlphaMode mode, float alpha, glm::vec3 albedo, glm::vec3 emission) {
    Scene scene;
    Material material = test::diffuse(albedo, emission);
    material.alpha_mode = mode;
    material.base_color.a = alpha;
    test::add_floor(scene, material, 10'000.0f);
    return scene;
}

/// Irradiance of a surface that faces down (red): exact, as all light comes from below.
double from_below(const RadianceSh& light) {
    return -static_cast<double>(light.coefficients[1].x) / kBand1;
}

TEST(Transparency, OpacityScalesEmission) {
    for (const float alpha : {0.25f, 0.5f, 1.0f}) {
        const Scene scene = ground(AlphaMode::Blend, alpha, glm::vec3(0.0f), glm::vec3(2.0f));
        EXPECT_NEAR(from_below(bake(scene)), static_cast<double>(alpha) * 2.0 * kPi,
                    0.02 * 2.0 * kPi)
            << alpha;
    }
}

TEST(Transparency, OpacityScalesReflectedLight) {
    // A sun of π from above: radiance albedo · alpha. The light that came through is gone below.
    for (const float alpha : {0.25f, 0.5f, 1.0f}) {
        Scene scene = ground(AlphaMode::Blend, alpha, glm::vec3(0.8f), glm::vec3(0.0f));
        test::add_sun(scene, LightMode::Mixed, glm::vec3(static_cast<float>(kPi)));
        EXPECT_NEAR(from_below(bake(scene)), static_cast<double>(alpha) * 0.8 * kPi,
                    0.02 * 0.8 * kPi)
            << alpha;
    }
}

TEST(Transparency, InvisibleSurfacesContributeNothing) {
    for (const AlphaMode mode : {AlphaMode::Blend, AlphaMode::Mask}) {
        Scene scene = ground(mode, 0.0f, glm::vec3(0.9f), glm::vec3(5.0f));
        test::add_sun(scene, LightMode::Baked, glm::vec3(3.0f)).radius = 0.05f;
        scene.environment.radiance = {1, 2, 3};
        Scene empty;
        empty.lights = scene.lights;
        empty.light_names = scene.light_names;
        empty.environment = scene.environment;
        const RadianceSh with = bake(scene), without = bake(empty);
        for (size_t i = 0; i < kShCoefficientCount; ++i) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(with.coefficients[i][c], without.coefficients[i][c], 0.01f) << i;
            }
        }
    }
}

TEST(Transparency, CutOutSurfacesEmitAndReflectOutsideTheirHoles) {
    // Half of the ground, in stripes that are small beside the distance.
    Scene scene;
    Texture stripes;
    stripes.image = {2, 1, {{255, 255, 255, 255}, {255, 255, 255, 0}}};
    scene.textures.push_back(stripes);
    Material material = test::diffuse(glm::vec3(0.0f), glm::vec3(2.0f));
    material.base_color_texture.texture = 0;
    material.alpha_mode = AlphaMode::Mask;
    material.base_color_texture.image_from_mesh[0][0] = 4000.0f;
    test::add_floor(scene, material, 100.0f);
    // The horizon beyond 100 m takes 1e-4 of the cosine.
    EXPECT_NEAR(from_below(bake(scene)), 0.5 * 2.0 * kPi, 0.03 * 2.0 * kPi);
}

TEST(Transparency, BouncesPassThroughAsRaysDo) {
    // Light of the ground reaches the probe through a pane that transmits 60 %.
    Scene scene = ground(AlphaMode::Opaque, 1.0f, glm::vec3(0.0f), glm::vec3(1.0f));
    Material pane = test::diffuse(glm::vec3(0.0f));
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.4f;
    pane.is_double_sided = true;
    test::add_floor(scene, pane, 10'000.0f, 0.5f);
    EXPECT_NEAR(from_below(bake(scene)), 0.6 * kPi, 0.02 * kPi);
}

/// The material of a double-sided pane that lets a fraction of light through, read from glTF.
Material pane_of_glass(float grey, float transmission) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["material"] = gltf.add(
        "materials",
        {{"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {grey, grey, grey, 1}}, {"metallicFactor", 0}}},
         {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}}}});
    gltf.add_root({{"mesh", mesh}});
    const auto scene = gltf.read();
    EXPECT_TRUE(scene);
    return scene ? scene->materials.at(0) : Material();
}

struct Glass {
    float grey = 1.0f;
    float transmission = 1.0f;
};

class TransparencyOfGlass : public testing::TestWithParam<Glass> {
  protected:
    /// Fraction that shines through: of all but the 4 % that dielectrics mirror.
    double through_ = 0.96 * static_cast<double>(GetParam().grey * GetParam().transmission);
    /// Fraction that a rough pane reflects diffusely: half of 4 %, and what is not transmitted.
    double reflected_ =
        0.02 + 0.96 * static_cast<double>(GetParam().grey * (1.0f - GetParam().transmission));

    /// Light from below at these heights over a ground, under a sun of π and a pane at 0.5 m.
    [[nodiscard]] static std::vector<double> from_below_at(const std::vector<double>& heights,
                                                           float ground_albedo, bool has_sun) {
        Scene scene;
        scene.environment.radiance = glm::vec3(has_sun ? 0.0f : 1.0f);
        if (has_sun) test::add_sun(scene, LightMode::Mixed, glm::vec3(static_cast<float>(kPi)));
        test::add_floor(scene, test::diffuse(glm::vec3(ground_albedo)), 10'000.0f);
        test::add_floor(scene, pane_of_glass(GetParam().grey, GetParam().transmission), 10'000.0f,
                        0.5f);
        std::vector<glm::dvec3> positions;
        for (const double height : heights) positions.emplace_back(0.3, height, 0.1);
        BakeSettings settings;
        settings.sample_count = 1 << 16;
        settings.bounces = 1;
        const auto baked = bake_probes(scene, positions, settings);
        EXPECT_TRUE(baked) << error_text(baked.error());
        std::vector<double> light;
        for (const RadianceSh& radiance : baked->radiance) light.push_back(from_below(radiance));
        return light;
    }
};

TEST_P(TransparencyOfGlass, SunlightBelowAndAboveAPane) {
    // One bounce: below the pane the ground alone is lit, by what shines through. Above it there is
    // what the pane reflects, and the ground seen through the pane.
    const auto light = from_below_at({0.25, 1.0}, 0.5f, true);
    EXPECT_NEAR(light[0], 0.5 * through_ * kPi, 0.01 * kPi);
    EXPECT_NEAR(light[1], (reflected_ + 0.5 * through_ * through_) * kPi, 0.01 * kPi);
}

TEST_P(TransparencyOfGlass, SkylightAboveAPaneOverABlackGround) {
    // The first band is what comes from below less what comes from above, π of the sky.
    EXPECT_NEAR(from_below_at({1.0}, 0.0f, false)[0], (reflected_ - 1.0) * kPi, 0.01 * kPi);
}

INSTANTIATE_TEST_SUITE_P(All, TransparencyOfGlass,
                         testing::Values(Glass{1.0f, 1.0f}, Glass{1.0f, 0.5f}, Glass{0.5f, 0.75f}));

}  // namespace
}  // namespace tetralight
