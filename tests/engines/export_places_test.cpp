// SPDX-License-Identifier: Apache-2.0
// The formats that hold the light of places. Each is evaluated as the shaders of its engine do.
#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/image/rgbd.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/engines/export_target.h>
#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Coefficients = std::array<glm::vec3, 9>;

constexpr float kPi = std::numbers::pi_v<float>;

Result<ExportedVolume> exported(const char* target, const ProbeVolume& volume,
                                std::vector<glm::dvec3> places, const char* name = "v") {
    ExportSettings settings{.name = name};
    settings.places = std::move(places);
    return find_export_target(target)->make(volume.view(), settings);
}

std::string content_of(const char* target, const ProbeVolume& volume,
                       std::vector<glm::dvec3> places) {
    const auto result = exported(target, volume, std::move(places));
    EXPECT_TRUE(result);
    EXPECT_EQ(result->files.size(), 1u);
    return result->files[0].content;
}

ProbeVolume volume_of_noise() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(40, 11));
    std::mt19937_64 engine(3);
    for (IrradianceSh& light : volume.irradiance) {
        light.coefficients[0] = glm::vec3(9.0f);
        for (size_t i = 1; i < 9; ++i) light.coefficients[i] = test::random_direction(engine);
    }
    return volume;
}

const std::vector<glm::dvec3> kPlaces{{0, 0, 0}, {0.2, -0.1, 0.3}, {-0.3, 0.25, 0.1}, {5, 1, -2}};

std::vector<glm::vec3> normals() {
    std::vector<glm::vec3> normals{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                   {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    std::mt19937_64 engine(5);
    for (int i = 0; i < 10; ++i) normals.push_back(test::random_direction(engine));
    return normals;
}

/// Checks that `irradiance(normal)` is what the volume has at a place.
template <class Irradiance>
void expect_light(const ProbeVolume& volume, const glm::dvec3& place, Irradiance&& irradiance) {
    const IrradianceSh light = light_at(volume.view(), place, Walls::HideProbes);
    for (const glm::vec3& n : normals()) {
        const glm::vec3 expected = evaluate_irradiance(light, n);
        const glm::vec3 shown = irradiance(n);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], 2e-5f) << n.x << ' ' << n.y;
    }
}

glm::vec3 playcanvas_ambient(const Coefficients& sh, const glm::vec3& n) {
    return sh[0] + sh[1] * n.x + sh[2] * n.y + sh[3] * n.z + sh[4] * (n.x * n.z) +
           sh[5] * (n.z * n.y) + sh[6] * (n.y * n.x) + sh[7] * (3.0f * n.z * n.z - 1.0f) +
           sh[8] * (n.x * n.x - n.y * n.y);
}

glm::vec3 filament_irradiance(const Coefficients& sh, const glm::vec3& n) {
    return sh[0] + sh[1] * n.y + sh[2] * n.z + sh[3] * n.x + sh[4] * (n.y * n.x) +
           sh[5] * (n.y * n.z) + sh[6] * (3.0f * n.z * n.z - 1.0f) + sh[7] * (n.z * n.x) +
           sh[8] * (n.x * n.x - n.y * n.y);
}

/// The sum that Babylon.js' shader makes: a basis with the Condon-Shortley phase, and a normal of
/// its left-handed world, whose x is mirrored.
glm::vec3 babylon_irradiance(const Coefficients& sh, glm::vec3 n) {
    n.x = -n.x;
    return sh[0] * 0.282095f - sh[1] * (0.488603f * n.y) + sh[2] * (0.488603f * n.z) -
           sh[3] * (0.488603f * n.x) + sh[4] * (1.092548f * n.x * n.y) -
           sh[5] * (1.092548f * n.y * n.z) + sh[6] * (0.315392f * (3.0f * n.z * n.z - 1.0f)) -
           sh[7] * (1.092548f * n.x * n.z) + sh[8] * (0.546274f * (n.x * n.x - n.y * n.y));
}

TEST(ExportPlayCanvas, ShadersShowTheLightOfPlaces) {
    const ProbeVolume volume = volume_of_noise();
    const auto json = nlohmann::json::parse(content_of("playcanvas", volume, kPlaces));
    ASSERT_EQ(json["places"].size(), kPlaces.size());
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        const auto numbers = json["places"][i]["ambientSH"].get<std::vector<float>>();
        ASSERT_EQ(numbers.size(), 27u);
        Coefficients sh;
        std::memcpy(sh.data(), numbers.data(), sizeof sh);
        expect_light(volume, kPlaces[i],
                     [&](const glm::vec3& n) { return kPi * playcanvas_ambient(sh, n); });
        EXPECT_EQ(json["places"][i]["position"][1].get<double>(), kPlaces[i].y);
    }
}

TEST(ExportPlayCanvas, HasEveryProbeWithoutPlaces) {
    const ProbeVolume volume = volume_of_noise();
    const auto json = nlohmann::json::parse(content_of("playcanvas", volume, {}));
    ASSERT_EQ(json["places"].size(), volume.positions.size());
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        const glm::dvec3 p = volume.info.world_origin + glm::dvec3(volume.positions[i]);
        EXPECT_EQ(json["places"][i]["position"].get<std::vector<double>>(),
                  (std::vector{p.x, p.y, p.z}));
        EXPECT_NEAR(json["places"][i]["ambientSH"][0].get<float>(), 9.0f * 0.282095f / kPi, 1e-5f);
    }
}

/// Reads lines as Filament's samples do.
Coefficients filament_coefficients(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    Coefficients sh;
    for (glm::vec3& c : sh) {
        std::getline(lines, line);
        EXPECT_EQ(std::sscanf(line.c_str(), "(%f,%f,%f)", &c.r, &c.g, &c.b), 3) << line;
    }
    EXPECT_FALSE(std::getline(lines, line));
    return sh;
}

TEST(ExportFilament, ShadersShowTheLightOfAPlace) {
    const ProbeVolume volume = volume_of_noise();
    for (const glm::dvec3& place : kPlaces) {
        const Coefficients sh = filament_coefficients(content_of("filament", volume, {place}));
        expect_light(volume, place,
                     [&](const glm::vec3& n) { return kPi * filament_irradiance(sh, n); });
    }
}

TEST(ExportFilament, TakesTheCenterOfTheProbesWithoutAPlace) {
    const ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 8}});
    const auto result = exported("filament", volume, {});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->notes, std::vector<std::string>{"The light of all places but 2, 1, 4."});
    EXPECT_EQ(result->files[0].content, content_of("filament", volume, {{2, 1, 4}}));
}

TEST(ExportPlaces, OneOfThemIsAllThatFilamentAndBabylonHold) {
    for (const char* target : {"filament", "babylon"}) {
        const auto result = exported(target, volume_of_noise(), kPlaces);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().field, "places");
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
    }
}

/// A .glb file, its light, and the images of the light.
struct BabylonFile {
    nlohmann::json json;
    nlohmann::json light;
    std::string binary;

    explicit BabylonFile(const std::string& glb) {
        uint32_t length = 0;
        std::memcpy(&length, glb.data() + 12, sizeof length);
        json = nlohmann::json::parse(glb.substr(20, length));
        binary = glb.substr(20 + length + 8);
        light = json["extensions"]["EXT_lights_image_based"]["lights"][0];
    }

    [[nodiscard]] Coefficients coefficients() const {
        Coefficients sh;
        for (size_t i = 0; i < 9; ++i) {
            const auto c = light["irradianceCoefficients"][i].get<std::vector<float>>();
            sh[i] = light["intensity"].get<float>() * glm::vec3(c[0], c[1], c[2]);
        }
        return sh;
    }

    [[nodiscard]] ImageF face(size_t level, size_t face) const {
        const size_t image = light["specularImages"][level][face];
        const auto& view = json["bufferViews"][json["images"][image]["bufferView"].get<size_t>()];
        const std::string png = binary.substr(view["byteOffset"], view["byteLength"]);
        return decode_rgbd(*decode_image8(std::as_bytes(std::span(png)), "face"));
    }
};

TEST(ExportBabylon, ShadersShowTheLightOfAPlace) {
    const ProbeVolume volume = volume_of_noise();
    for (const glm::dvec3& place : kPlaces) {
        const BabylonFile file(content_of("babylon", volume, {place}));
        const Coefficients sh = file.coefficients();
        expect_light(volume, place, [&](const glm::vec3& n) { return babylon_irradiance(sh, n); });
    }
}

/// In Babylon.js' world a face's image starts with its last row, and its x is minus ours.
TEST(ExportBabylon, ReflectionsShowTheSameLight) {
    const ProbeVolume volume = volume_of_noise();
    const BabylonFile file(content_of("babylon", volume, {kPlaces[1]}));
    const IrradianceSh light = light_at(volume.view(), kPlaces[1], Walls::HideProbes);
    const RadianceSh mirror = radiance_from_irradiance(light);
    ASSERT_EQ(file.light["specularImages"].size(), 5u);
    EXPECT_EQ(file.light["specularImageSize"], 16);
    const ImageF minus_x = file.face(0, 0);  // Babylon's +X
    ASSERT_EQ(minus_x.width, 16u);
    // Texel (12, 2) of face +X looks to +X, y = 1 - 5 / 16, z = 1 - 25 / 16 in Babylon's world.
    const glm::vec3 d = glm::normalize(glm::vec3(-1.0f, 1 - 5 / 16.0f, 1 - 25 / 16.0f));
    const glm::vec3 mirror_light = evaluate_radiance(mirror, d);
    const glm::vec3 shown = minus_x.pixels[size_t{16 - 1 - 2} * 16 + 12];
    // The roughest level has one texel a face, with E / pi.
    const glm::vec3 rough_light = evaluate_irradiance(light, {0, 1, 0}) / kPi;
    const glm::vec3 rough = file.face(4, 2).pixels[0];
    const float intensity = file.light["intensity"];
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(intensity * shown[c], mirror_light[c], 0.04f * mirror_light[c]);
        EXPECT_NEAR(intensity * rough[c], rough_light[c], 0.04f * rough_light[c]);
    }
}

TEST(ExportBabylon, BrightLightIsDividedByTheIntensity) {
    ProbeVolume volume = volume_of_noise();
    for (IrradianceSh& light : volume.irradiance) light *= 1e4f;
    const BabylonFile file(content_of("babylon", volume, {kPlaces[0]}));
    EXPECT_GT(file.light["intensity"].get<float>(), 1.0f);
    const IrradianceSh light = light_at(volume.view(), kPlaces[0], Walls::HideProbes);
    EXPECT_NEAR(file.coefficients()[0].g / light.coefficients[0].g, 1.0f, 1e-5f);
}

TEST(ExportBabylon, IsGltfWhoseLightIsNotTheSky) {
    const TempFolder folder;
    const auto result = exported("babylon", volume_of_noise(), {kPlaces[0]}, "bad \xFF name");
    ASSERT_TRUE(result);
    const auto scene = read_gltf(folder.write("v.glb", result->files[0].content));
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->warnings.empty());
    EXPECT_EQ(scene->environment, Environment{});
}

}  // namespace
}  // namespace tetralight
