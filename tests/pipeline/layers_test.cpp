// SPDX-License-Identifier: Apache-2.0
// Bakes whose light is split into layers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/bake/project_environment.h>
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/probes/relight.h>
#include <tetralight/probes/sh_minimum.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// A court under a sky image: a baked sun, a mixed lamp, a screen that shines, one that is `lava`.
Scene court() {
    Scene scene;
    test::add_floor(scene, test::diffuse({0.7f, 0.5f, 0.3f}), 4.0f);
    test::add_quad(scene, test::diffuse(glm::vec3(0.6f)), {-4, 0, -3}, {8, 0, 0}, {0, 4, 0});
    test::add_box(scene, test::diffuse({0.3f, 0.6f, 0.8f}), test::Facing::Outward, {-1.6f, 0, 0.6f},
                  {-0.9f, 1.5f, 1.2f});
    test::add_quad(scene, test::diffuse(glm::vec3(0.2f), {4, 2, 1}), {-1, 1, -2.9f}, {1, 0, 0},
                   {0, 1, 0});
    test::add_quad(scene, test::diffuse(glm::vec3(0.2f), {0, 3, 1}), {2, 1, -2.9f}, {1, 0, 0},
                   {0, 1, 0});
    scene.materials[3].name = "neon";
    scene.materials[4].name = "lava";
    Light& sun = test::add_sun(scene, LightMode::Baked, {3, 2.5f, 2});
    sun.direction = glm::normalize(glm::vec3(-1, -2, 0.5f));
    sun.radius = 0.05f;
    test::add_point_light(scene, LightMode::Mixed, {5, 5, 9}, {1, 2.5f, 1}).radius = 0.1f;
    scene.light_names = {"sun", "lamp"};
    scene.environment.radiance = glm::vec3(1.0f);
    scene.environment.image = {16, 8, {}};
    for (int row = 0; row < 8; ++row) {
        const float height = std::cos(3.14159265f * (static_cast<float>(row) + 0.5f) / 8.0f);
        for (int column = 0; column < 16; ++column) {
            const float side = std::cos(6.2831853f * static_cast<float>(column) / 16.0f);
            scene.environment.image.pixels.emplace_back(0.6f + 0.3f * height, 0.7f + 0.4f * height,
                                                        1.0f + 0.5f * height + 0.2f * side);
        }
    }
    return scene;
}

const std::vector<std::string> kLayers = {"sun", "sky", "light:lamp", "material:neon"};

BakeVolumeSettings settings_of(std::vector<std::string> layers, uint32_t samples = 256) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = samples;
    settings.lighting.layers = std::move(layers);
    return settings;
}

std::vector<ProbeGroup> groups() {
    std::vector<glm::dvec3> positions;
    for (const glm::dvec3& p : test::random_positions(12, 1, 2.0)) {
        positions.emplace_back(p.x, 2.2 + 0.9 * p.y, p.z);
    }
    return {test::make_group("court", positions)};
}

ProbeVolume bake(const Scene& scene, const BakeVolumeSettings& settings) {
    auto baked = bake_volume(scene, groups(), settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    const Status status = verify(baked->volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
    return std::move(baked->volume);
}

double rms(const IrradianceSh& light) {
    double sum = 0.0;
    for (const glm::vec3& c : light.coefficients) sum += static_cast<double>(glm::dot(c, c));
    return std::sqrt(sum);
}

TEST(Layers, OfWeightOneSumToTheBitsOfTheUnlayeredBake) {
    const ProbeVolume plain = bake(court(), settings_of({}));
    const ProbeVolume layered = bake(court(), settings_of(kLayers));
    ASSERT_EQ(layered.layer_names, "sun\nsky\nlight:lamp\nmaterial:neon\nrest\n");
    size_t other_bits = 0;
    for (size_t i = 0; i < plain.irradiance.size(); ++i) {
        for (int k = 0; k < kShCoefficientCount; ++k) {
            for (int c = 0; c < 3; ++c) {
                const float a = plain.irradiance[i].coefficients[k][c];
                const float b = layered.irradiance[i].coefficients[k][c];
                other_bits += a != b;
                EXPECT_NEAR(a, b, 1e-6f * (1.0f + std::abs(a)));
            }
        }
    }
    EXPECT_LT(other_bits, plain.irradiance.size() * 27 / 20);  // where the rest is the larger
    EXPECT_EQ(layered.info.ambient, plain.info.ambient);
    EXPECT_EQ(layered.validity, plain.validity);
    EXPECT_EQ(layered.health, plain.health);
}

TEST(Layers, HaveErrorsOfTheirOwnWithTheRest) {
    const ProbeVolume layered = bake(court(), settings_of(kLayers));
    const size_t count = layered.positions.size();
    ASSERT_EQ(layered.layer_errors.size(), 5 * count);
    for (size_t i = 0; i < 5 * count; ++i) EXPECT_GT(layered.layer_errors[i], 0.0f) << i;
    // A scene with one layer alone has the error of the sum.
    Scene dark = court();
    for (Light& light : dark.lights) light.mode = LightMode::Realtime;
    for (Material& material : dark.materials) material.emission = glm::vec3(0.0f);
    const ProbeVolume sky = bake(dark, settings_of({"sky"}));
    ASSERT_EQ(sky.layer_names, "sky\n");
    for (size_t i = 0; i < count; ++i) {
        EXPECT_NEAR(sky.layer_errors[i], sky.health[i].standard_error, 1e-4f * sky.layer_errors[i]);
    }
}

TEST(Layers, EachIsWhatASceneWithThatLightAloneGives) {
    // Error bars of both bakes: the whole's standard error is an upper bound for a part's.
    const ProbeVolume layered = bake(court(), settings_of(kLayers, 4096));
    const auto dark = [] {
        Scene scene = court();
        scene.environment = {};
        for (Light& light : scene.lights) light.mode = LightMode::Realtime;
        for (Material& material : scene.materials) material.emission = glm::vec3(0.0f);
        return scene;
    };
    std::vector<Scene> alone(5, dark());
    alone[0].lights[0].mode = LightMode::Baked;
    alone[1].environment = court().environment;
    alone[2].lights[1].mode = LightMode::Mixed;
    alone[3].materials[3].emission = {4, 2, 1};
    alone[4].materials[4].emission = {0, 3, 1};
    const size_t count = layered.positions.size();
    for (size_t layer = 0; layer < alone.size(); ++layer) {
        const ProbeVolume expected = bake(alone[layer], settings_of({}, 4096));
        for (size_t i = 0; i < count; ++i) {
            const IrradianceSh& found = layered.layer_irradiance[layer * count + i];
            const double tolerance =
                5.0 * std::hypot(rms(layered.irradiance[i]) *
                                     static_cast<double>(layered.health[i].standard_error),
                                 rms(expected.irradiance[i]) *
                                     static_cast<double>(expected.health[i].standard_error));
            EXPECT_LT(rms(found + -1.0f * expected.irradiance[i]), tolerance + 1e-4)
                << layer << ' ' << i;
        }
    }
}

TEST(Layers, RecombinedAgreeWithAFreshBakeOfTheDimmedScene) {
    ProbeVolume layered = bake(court(), settings_of(kLayers, 4096));
    const std::vector<LayerWeight> changes{{"lamp", 0.0f}, {"neon", 2.0f}, {"sun", 0.5f}};
    const auto weights = layer_weights(layered.view(), changes);
    ASSERT_TRUE(weights && recombine(layered, *weights));
    Scene dimmed = court();
    dimmed.lights[0].intensity *= 0.5f;
    dimmed.lights[1].intensity = glm::vec3(0.0f);
    dimmed.materials[3].emission *= 2.0f;
    const ProbeVolume fresh = bake(dimmed, settings_of({}, 4096));
    for (size_t i = 0; i < fresh.irradiance.size(); ++i) {
        const double sigma = rms(fresh.irradiance[i]) *
                             static_cast<double>(fresh.health[i].standard_error) * std::sqrt(2.0);
        const double difference = rms(layered.irradiance[i] + -1.0f * fresh.irradiance[i]);
        EXPECT_LT(difference, 4.0 * sigma) << i;
    }
}

TEST(Layers, ClampedPathsKeepTheirSum) {
    BakeVolumeSettings settings = settings_of(kLayers);
    settings.bake.clamp = 0.5f;
    const ProbeVolume layered = bake(court(), settings);
    settings.lighting.layers.clear();
    const ProbeVolume plain = bake(court(), settings);
    for (size_t i = 0; i < plain.irradiance.size(); ++i) {
        EXPECT_LT(rms(layered.irradiance[i] + -1.0f * plain.irradiance[i]),
                  1e-6 * rms(plain.irradiance[i]));
    }
}

TEST(Layers, HaveNoRingingForAnyWeightsWhereDeringIsAskedFor) {
    BakeVolumeSettings settings = settings_of({"sun", "sky", "light:lamp", "emission"});
    settings.dering.is_for_all_groups = true;
    ProbeVolume volume = bake(court(), settings);
    EXPECT_EQ(find_layer(volume.view(), "rest"), kNoIndex);  // nothing is left
    for (size_t i = 0; i < volume.layer_irradiance.size(); ++i) {
        const glm::dvec3 least = minimum_irradiance(volume.layer_irradiance[i]);
        EXPECT_GE(std::min({least.x, least.y, least.z}), 0.0) << i;
    }
    ASSERT_TRUE(recombine(volume, std::vector<float>{3.0f, 0.0f, 0.1f, 0.0f}));
    for (const IrradianceSh& light : volume.irradiance) {
        const glm::dvec3 least = minimum_irradiance(light);
        EXPECT_GE(std::min({least.x, least.y, least.z}), -1e-6 * rms(light));
    }
}

TEST(Layers, DilateAndKeepTheirSum) {
    Scene scene = court();
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-6, 1, 5},
                  {6, 4, 9});
    BakeVolumeSettings settings = settings_of({"sun", "transfer"});
    settings.health.invalid = InvalidProbes::Dilate;
    settings.health.virtual_offset = 0.0;
    settings.lighting.mixed_lighting = MixedLighting::Shadowmask;
    std::vector<ProbeGroup> both = groups();
    both.push_back(test::make_group("wall", {{0, 2, 7}}));
    const auto baked = bake_volume(scene, both, settings);
    ASSERT_TRUE(baked);
    EXPECT_EQ(baked->report.dilated_count, 1u);
    const ProbeVolume& volume = baked->volume;
    ProbeVolume again = volume;
    ASSERT_TRUE(recombine(again, layer_weights(volume.view())));
    EXPECT_EQ(again, volume);
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        if (volume.health[i].is_dilated == 0) continue;
        EXPECT_GT(volume.layer_irradiance[i].coefficients[0].x, 0.0f);
        EXPECT_GT(volume.transfer[i].direct[0][0], 0.0f);
    }
}

// --- Transfer ------------------------------------------------------------------------------------

TEST(Transfer, MakesTheSkyLayerAgain) {
    ProbeVolume volume = bake(court(), settings_of({"sun", "transfer"}, 4096));
    const size_t count = volume.positions.size();
    const std::vector<IrradianceSh> sky(volume.layer_irradiance.begin() + count,
                                        volume.layer_irradiance.begin() + 2 * count);
    ASSERT_EQ(volume.sky.size(), 1u);
    ASSERT_TRUE(relight_sky(volume, volume.sky[0]));
    double error = 0.0, light = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const IrradianceSh difference = volume.layer_irradiance[count + i] + -1.0f * sky[i];
        error += rms(difference) * rms(difference);
        light += rms(sky[i]) * rms(sky[i]);
    }
    EXPECT_LT(std::sqrt(error / light), 0.02);
}

TEST(Transfer, RelitByAnotherSkyIsNearAFreshBake) {
    ProbeVolume volume = bake(court(), settings_of({"transfer"}, 4096));
    Scene other = court();
    for (glm::vec3& pixel : other.environment.image.pixels) {
        pixel = {1.2f - pixel.x, 0.2f, 2.0f * pixel.z * pixel.z};
    }
    other.environment.rotation_radians = 0.7f;
    ASSERT_TRUE(relight_sky(volume, project_sky(other.environment)));
    const ProbeVolume fresh = bake(other, settings_of({}, 4096));
    double error = 0.0, light = 0.0;
    for (size_t i = 0; i < fresh.irradiance.size(); ++i) {
        const IrradianceSh difference = volume.irradiance[i] + -1.0f * fresh.irradiance[i];
        error += rms(difference) * rms(difference);
        light += rms(fresh.irradiance[i]) * rms(fresh.irradiance[i]);
    }
    EXPECT_LT(std::sqrt(error / light), 0.03);
    EXPECT_LT(rms(volume.info.ambient + -1.0f * fresh.info.ambient), 1e-4);
}

TEST(Transfer, OfAnOpenProbeIsTheClampedCosine) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    const ProbeVolume volume = bake(scene, settings_of({"transfer"}, 8192));
    const double factors[] = {3.14159265, 2.0943951, 0.785398163};
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double factor = factors[i == 0 ? 0 : i < 4 ? 1 : 2];
        for (int j = 0; j < kDistantCoefficientCount; ++j) {
            const float found =
                volume.transfer[3].direct[static_cast<size_t>(i)][static_cast<size_t>(j)];
            EXPECT_NEAR(found, i == j ? factor : 0.0, 0.01 * factor) << i << ' ' << j;
        }
    }
    EXPECT_EQ(volume.transfer[3].bounced, ProbeTransfer{}.bounced);
}

}  // namespace
}  // namespace tetralight
