// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>
#include <tetralight/render/render_scene.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/base/half.h>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// Probes all over [-9, 9]³ with the same radiance from everywhere.
ProbeVolume constant_volume(float radiance) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1, 9.0));
    for (IrradianceSh& sh : volume.irradiance)
        sh = irradiance_from_radiance(constant_radiance(glm::vec3(radiance)));
    return volume;
}

/// One cube that is everywhere, whose faces have the radiance 1, 2... 6.
Reflections six_colors() {
    Reflections reflections;
    reflections.size = 8;
    reflections.probes.emplace_back();
    reflections.probes[0].irradiance = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    reflections.levels.resize(1);
    for (int face = 1; face <= 6; ++face) {
        const uint16_t light = half_from_float(static_cast<float>(face));
        for (int texel = 0; texel < 64; ++texel)
            reflections.levels[0].push_back({light, light, light, half_from_float(1.0f)});
    }
    return reflections;
}

/// A floor of a material, seen straight from above.
float seen_from_above(const Material& material, const ProbeVolume& volume,
                      const Reflections& reflections) {
    Scene scene;
    test::add_floor(scene, material, 5.0f);
    auto light = make_scene_light(scene, volume.view(), ProbeLight::AsTheScene);
    EXPECT_TRUE(light);
    light->reflections = reflections.view();
    const auto shader = SceneShader::make(scene, volume.view(), std::move(*light));
    EXPECT_TRUE(shader);
    return shader->shade({0.5, 2.0, 0.3}, {0, -1, 0})->radiance.x;
}

Material metal(float roughness) {
    Material material;
    material.base_color = glm::vec4(1.0f);
    material.metallic = 1.0f;
    material.roughness = roughness;
    return material;
}

TEST(Reflections, AMirrorShowsTheFaceThatItsNormalPointsTo) {
    // Face +Y has radiance 3; a white mirror reflects scale + bias of it, which is nearly 1.
    const glm::vec2 terms = sample_split_sum(make_split_sum_table(), 1.0f, 0.0f);
    EXPECT_NEAR(terms.x + terms.y, 1.0f, 0.01f);
    EXPECT_NEAR(seen_from_above(metal(0.0f), constant_volume(1.0f), six_colors()),
                3.0f * (terms.x + terms.y), 1e-3f);
}

TEST(Reflections, ADarkPlaceDarkensThoseOfRoughSurfaces) {
    // The light at the floor is a quarter of that at the cube.
    const auto darkened = [](float roughness) {
        const float bright = seen_from_above(metal(roughness), constant_volume(1.0f), six_colors());
        const float dark = seen_from_above(metal(roughness), constant_volume(0.25f), six_colors());
        return dark / bright;
    };
    EXPECT_NEAR(darkened(0.6f), 0.25f, 1e-3f);
    EXPECT_NEAR(darkened(0.0f), 1.0f, 1e-3f);
}

TEST(Reflections, ADielectricKeepsItsDiffuseLight) {
    Material plastic = metal(0.3f);
    plastic.metallic = 0.0f;
    plastic.base_color = {0.5f, 0.5f, 0.5f, 1.0f};
    const glm::vec2 terms = sample_split_sum(make_split_sum_table(), 1.0f, 0.3f);
    EXPECT_NEAR(seen_from_above(plastic, constant_volume(1.0f), six_colors()),
                0.5f * 0.96f + 3.0f * (0.04f * terms.x + terms.y), 1e-3f);
}

TEST(Reflections, WithoutProbesNothingIsMirrored) {
    // Half of the specular reflection, times the roughness, counts as diffuse.
    EXPECT_NEAR(seen_from_above(metal(0.8f), constant_volume(1.0f), Reflections{}), 0.4f, 1e-3f);
}

TEST(Reflections, FarReflectionsIgnoreBoxes) {
    Reflections reflections = six_colors();
    reflections.probes[0].half_size = {1.0f, 1.0f, 1.0f};
    const ReflectionBlend blend = blend_reflections(reflections.view(), {0.9, 0.0, 0.0});
    // From near the right side, a ray up and slightly right hits the right side of the box.
    const glm::vec3 direction(0.2f, 1.0f, 0.0f);
    EXPECT_EQ(sample_far_reflections(reflections.view(), blend, direction, 0.0f).x, 3.0f);
    EXPECT_EQ(sample_reflections(reflections.view(), blend, {0.9, -0.5, 0.0}, direction, 0.0f).x,
              1.0f);
}

}  // namespace
}  // namespace tetralight
