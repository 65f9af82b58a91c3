// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_reflection_glb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/reflection/cube_image.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// Smooth light without a symmetry, which two bands of spherical harmonics hold; in (0.1, 5).
glm::vec3 smooth_light(glm::vec3 d) {
    return {1.5f + d.x + 0.3f * d.y, 2.0f + 1.5f * d.y * d.z - d.z, 0.6f + 0.4f * d.x * d.z};
}

/// Two probes, of which the second sees `scale` times the smooth light, in two levels.
Reflections two_probes(float scale) {
    Reflections all;
    all.size = 16;
    all.probes.resize(2);
    RadianceShSum sum;
    for (uint32_t level = 0; level < 2; ++level) {
        const uint32_t size = all.size >> level;
        auto& texels = all.levels.emplace_back(size_t{6} * size * size);
        for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
            for (uint32_t i = 0; i < size * size; ++i) {
                const CubeTexel texel{face, i % size, i / size};
                const glm::vec3 direction = cube_direction(texel, size);
                const glm::vec3 light =
                    scale * (1.0f + static_cast<float>(level)) * smooth_light(direction);
                texels.push_back({half_from_float(light.x), half_from_float(light.y),
                                  half_from_float(light.z), half_from_float(1.0f)});
                const double area = cube_solid_angle(texel.x, texel.y, size);
                if (level == 0) sum.add(direction, static_cast<float>(area) * light);
            }
        }
    }
    all.probes[1].irradiance = irradiance_from_radiance(radiance_from_sum(sum, 1.0));
    return all;
}

/// The light of a texel of the second probe.
glm::vec3 light_of(const Reflections& all, uint32_t level, const CubeTexel& texel) {
    const uint32_t size = all.size >> level;
    const size_t face = kCubeFaceCount + texel.face;
    const auto& t = all.levels[level][(face * size + texel.y) * size + texel.x];
    return {float_from_half(t[0]), float_from_half(t[1]), float_from_half(t[2])};
}

/// Babylon.js' left-handed world is glTF's with x mirrored.
glm::vec3 mirrored(glm::vec3 v) {
    return {-v.x, v.y, v.z};
}

/// What Babylon.js' loader makes of a file: `faces[level][face]`, and the coefficients.
struct LoadedLight {
    std::vector<std::vector<Image8>> faces;
    std::vector<glm::vec3> coefficients;
    float intensity = 0.0f;

    /// The pixel of a texel of a cube map, for a sampler in its world: the loader turns the rows.
    [[nodiscard]] std::array<uint8_t, 4> pixel(uint32_t level, const CubeTexel& texel) const {
        const Image8& image = faces[level][texel.face];
        const size_t row = image.height - 1 - texel.y;
        return image.pixels[row * image.width + texel.x];
    }

    /// The light of a channel whose code is `code`.
    [[nodiscard]] double light(double code, uint8_t alpha) const {
        return intensity * std::pow(std::max(code, 0.0) / 255.0, 2.2) / (alpha / 255.0);
    }

    [[nodiscard]] glm::dvec3 texel(uint32_t level, const CubeTexel& texel) const {
        const auto [r, g, b, alpha] = pixel(level, texel);
        return {light(r, alpha), light(g, alpha), light(b, alpha)};
    }

    /// The irradiance that its shader adds up: with the Condon-Shortley phase.
    [[nodiscard]] glm::vec3 irradiance(glm::vec3 normal) const {
        const auto basis = sh_basis(normal);
        const std::array<float, 9> phase{1, -1, 1, -1, 1, -1, 1, -1, 1};
        glm::vec3 sum(0.0f);
        for (size_t i = 0; i < 9; ++i) sum += phase[i] * basis[i] * coefficients[i];
        return intensity * sum;
    }
};

class WriteReflectionGlb : public testing::Test {
  protected:
    WriteReflectionGlb()
        : scene_(folder_.write("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
              "scenes": [{"nodes": [0]}], "nodes": [{"name": "empty"}]})")) {}

    [[nodiscard]] LoadedLight loaded(const Reflections& all) const {
        const auto intensity = write_reflection_glb(path_, scene_, all.view(), 1, "hall");
        EXPECT_TRUE(intensity) << (intensity ? "" : error_text(intensity.error()));
        const auto bytes = *read_file(path_);
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        uint32_t length = 0;
        std::memcpy(&length, text.data() + 12, sizeof length);
        const Json json = Json::parse(text.substr(20, length));
        const Json& light = json["extensions"]["EXT_lights_image_based"]["lights"][0];
        EXPECT_EQ(light["intensity"].get<float>(), *intensity);
        LoadedLight result;
        result.intensity = *intensity;
        for (const Json& c : light["irradianceCoefficients"])
            result.coefficients.emplace_back(c[0].get<float>(), c[1].get<float>(),
                                             c[2].get<float>());
        for (const Json& level : light["specularImages"]) {
            auto& faces = result.faces.emplace_back();
            for (const size_t image : level) {
                const Json& view =
                    json["bufferViews"][json["images"][image]["bufferView"].get<size_t>()];
                const size_t first = 20 + length + 8 + view["byteOffset"].get<size_t>();
                const auto png = std::span(bytes).subspan(first, view["byteLength"]);
                faces.push_back(*decode_image8(png, "face"));
            }
        }
        return result;
    }

    TempFolder folder_;
    std::string scene_;
    std::string path_ = folder_.path("lit.glb");
};

/// The texel that a direction hits.
CubeTexel texel_at(glm::vec3 direction, uint32_t size) {
    const CubePlace place = cube_place(direction);
    const glm::vec2 xy = place.uv * static_cast<float>(size);
    return {place.face, static_cast<uint32_t>(xy.x), static_cast<uint32_t>(xy.y)};
}

/// Checks that the light of each texel is within half a step of its pixel, in its direction.
void expect_the_cube(const LoadedLight& light, const Reflections& all) {
    ASSERT_EQ(light.faces.size(), all.levels.size());
    for (uint32_t level = 0; level < all.levels.size(); ++level) {
        const uint32_t size = all.size >> level;
        for (uint32_t i = 0; i < kCubeFaceCount * size * size; ++i) {
            const CubeTexel texel{i / (size * size), i % size, i / size % size};
            ASSERT_EQ(light.faces[level][texel.face].width, size);
            const auto pixel = light.pixel(level, texel);
            const glm::vec3 direction = mirrored(cube_direction(texel, size));
            const glm::vec3 expected = light_of(all, level, texel_at(direction, size));
            for (int channel = 0; channel < 3; ++channel) {
                const double code = pixel[static_cast<size_t>(channel)];
                ASSERT_GE(expected[channel], light.light(code - 0.501, pixel[3])) << i;
                ASSERT_LE(expected[channel], light.light(code + 0.501, pixel[3])) << i;
            }
        }
    }
}

TEST_F(WriteReflectionGlb, LevelsAreForEqualStepsOfRoughness) {
    // Level k has light 1 + k everywhere. Roughness 0.5 is at level 0.5 (2 - 0.5) 2 = 1.5.
    Reflections all;
    all.size = 8;
    all.probes.resize(2);
    for (uint32_t level = 0; level < 3; ++level) {
        const uint16_t light = half_from_float(1.0f + static_cast<float>(level));
        all.levels.emplace_back(2 * cube_texel_count(all.size >> level),
                                RadianceTexel{light, light, light, half_from_float(1.0f)});
    }
    const LoadedLight light = loaded(all);
    for (const auto& [level, expected] : {std::pair{0u, 1.0}, {1u, 2.5}, {2u, 3.0}}) {
        EXPECT_EQ(light.faces[level][0].width, 8u >> level);
        EXPECT_NEAR(light.texel(level, {3, 1, 0}).g, expected, 0.02 * expected);
    }
}

TEST_F(WriteReflectionGlb, TheImagesHaveTheLightOfTheCube) {
    const Reflections all = two_probes(1.0f);
    const LoadedLight light = loaded(all);
    EXPECT_EQ(light.intensity, 1.0f);
    expect_the_cube(light, all);
}

TEST_F(WriteReflectionGlb, BrightLightIsDividedByTheIntensity) {
    // The largest channel of level 1 is green where x = 0: 2 (2 + 1.52) = 7.04 times the scale.
    const std::pair<float, float> scales[] = {
        {5000.0f, 256.0f}, {1000.0f, 32.0f}, {35.0f, 1.0f}, {0.1f, 1.0f}};
    for (const auto& [scale, intensity] : scales) {
        const Reflections all = two_probes(scale);
        const LoadedLight light = loaded(all);
        EXPECT_EQ(light.intensity, intensity) << scale;
        expect_the_cube(light, all);
    }
}

TEST_F(WriteReflectionGlb, DarknessIsWritten) {
    const LoadedLight light = loaded(two_probes(0.0f));
    EXPECT_EQ(light.intensity, 1.0f);
    for (uint32_t face = 0; face < kCubeFaceCount; ++face)
        EXPECT_EQ(light.texel(0, {face, 3, 7}), glm::dvec3(0.0));
}

TEST_F(WriteReflectionGlb, TheCoefficientsAreTheIrradianceOfTheImages) {
    for (const float scale : {1.0f, 500.0f}) {
        const LoadedLight light = loaded(two_probes(scale));
        for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0.2f, 0.1f),
                                     glm::vec3(0.3f, 1, -2), glm::vec3(-1, -1, 1)}) {
            const glm::vec3 normal = glm::normalize(axis);
            glm::dvec3 gathered(0.0);
            for (uint32_t i = 0; i < kCubeFaceCount * 16 * 16; ++i) {
                const CubeTexel texel{i / 256, i % 16, i / 16 % 16};
                const double cosine = glm::dot(cube_direction(texel, 16), normal);
                const double area = cube_solid_angle(texel.x, texel.y, 16);
                gathered += std::max(cosine, 0.0) * area * light.texel(0, texel);
            }
            EXPECT_LT(glm::length(light.irradiance(normal) - glm::vec3(gathered)),
                      0.01f * glm::length(gathered))
                << scale << ' ' << normal.x << ' ' << normal.y << ' ' << normal.z;
        }
    }
}

TEST_F(WriteReflectionGlb, OurReaderReadsTheSceneAgain) {
    ASSERT_TRUE(write_reflection_glb(path_, scene_, two_probes(1.0f).view(), 0, "hall"));
    const auto scene = read_gltf(path_);
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->warnings.empty());
}

TEST_F(WriteReflectionGlb, TheLightOfAPlaceIsNoSkyOfTheSceneThatIsReadAgain) {
    Reflections all = two_probes(1.0f);
    all.probes[1].half_size = glm::vec3(2.0f, 1.0f, 3.0f);
    ASSERT_TRUE(write_reflection_glb(path_, scene_, all.view(), 1, "hall"));
    const auto scene = read_gltf(path_);
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->warnings.empty());
    EXPECT_EQ(scene->environment, Environment{});
}

TEST_F(WriteReflectionGlb, TheSkyIsReadAgain) {
    for (const float scale : {1.0f, 500.0f}) {
        const Reflections all = two_probes(scale);
        ASSERT_TRUE(all.probes[1].is_everywhere());
        ASSERT_TRUE(write_reflection_glb(path_, scene_, all.view(), 1, "sky"));
        const auto scene = read_gltf(path_);
        ASSERT_TRUE(scene) << error_text(scene.error());
        EXPECT_TRUE(scene->warnings.empty());
        for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0.2f, 0.1f),
                                     glm::vec3(0.3f, 1, -2), glm::vec3(-1, -1, 1)}) {
            const glm::vec3 direction = glm::normalize(axis);
            const glm::vec3 expected = scale * smooth_light(direction);
            // Texels are a tenth of a radian wide, and codes round by 1 %.
            const glm::vec3 read = environment_radiance(scene->environment, direction);
            EXPECT_LT(glm::length(read - expected), 0.04f * glm::length(expected)) << axis.x;
        }
    }
}

TEST_F(WriteReflectionGlb, AFailureKeepsTheOldFile) {
    folder_.write("lit.glb", "old");
    folder_.write("scene.gltf", "{");
    const auto status = write_reflection_glb(path_, scene_, two_probes(1.0f).view(), 1, "hall");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(error_text(status.error()).find(scene_), 0u);
    EXPECT_EQ(read_file(path_)->size(), 3u);
}

}  // namespace
}  // namespace tetralight
