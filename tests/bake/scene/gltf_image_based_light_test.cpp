// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_image_based_light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/probes/sh.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;
using Pixel = std::array<uint8_t, 4>;

const char* const kExtension = "EXT_lights_image_based";
constexpr double kPi = std::numbers::pi;
constexpr Pixel kBlack{0, 0, 0, 255};
constexpr Pixel kRed{255, 0, 0, 51};  // a radiance of 255 / 51 = 5

/// The code of a pixel of a face's image, top row first.
using PixelOf = std::function<Pixel(size_t face, uint32_t column, uint32_t row)>;

size_t add_image(GltfBuilder& gltf, const Image8& image) {
    const size_t view = gltf.add_view(*encode_png(image));
    return gltf.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
}

/// Indices of the images of six faces of `size` texels.
Json add_faces(GltfBuilder& gltf, uint32_t size, const PixelOf& pixel_of) {
    Json faces = Json::array();
    for (size_t face = 0; face < 6; ++face) {
        Image8 image{size, size, {}};
        for (uint32_t i = 0; i < size * size; ++i)
            image.pixels.push_back(pixel_of(face, i % size, i / size));
        faces.push_back(add_image(gltf, image));
    }
    return faces;
}

/// A scene that is lit by this light alone.
GltfBuilder lit_by(GltfBuilder gltf, Json light) {
    gltf.json["scene"] = 0;
    gltf.json["scenes"] = {{{"extensions", {{kExtension, {{"light", 0}}}}}}};
    gltf.json["extensionsUsed"] = {kExtension};
    gltf.json["extensions"][kExtension]["lights"] = Json::array({std::move(light)});
    return gltf;
}

/// A scene with a light of such faces and these further members.
GltfBuilder lit_scene(uint32_t size, const PixelOf& pixel_of, const Json& members = {}) {
    GltfBuilder gltf;
    Json light = {{"name", "studio"}, {"specularImageSize", size}};
    light["specularImages"] = {add_faces(gltf, size, pixel_of)};
    if (members.is_object()) light.update(members);
    return lit_by(std::move(gltf), light);
}

Scene read(const GltfBuilder& gltf) {
    auto scene = gltf.read();
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return scene ? std::move(*scene) : Scene{};
}

glm::vec3 radiance(const GltfBuilder& gltf, glm::vec3 direction) {
    return environment_radiance(read(gltf).environment, glm::normalize(direction));
}

void expect_near(glm::vec3 actual, glm::vec3 expected, float tolerance) {
    EXPECT_LT(glm::length(actual - expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' '
        << expected.y << ' ' << expected.z;
}

/// Where the light of face +X, -X, +Y... of a file is in glTF's world: Babylon.js' left-handed
/// world has x mirrored.
const std::array<glm::vec3, 6> kFaceDirections{glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0),
                                               glm::vec3(0, 1, 0),  glm::vec3(0, -1, 0),
                                               glm::vec3(0, 0, 1),  glm::vec3(0, 0, -1)};

PixelOf one_red_face(size_t red) {
    return [red](size_t face, uint32_t, uint32_t) { return face == red ? kRed : kBlack; };
}

TEST(GltfImageBasedLight, AConstantCubeIsAConstantSky) {
    const Scene scene = read(lit_scene(4, [](size_t, uint32_t, uint32_t) {
        return Pixel{255, 255, 0, 102};
    }));
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.environment.image.width, 16u);
    ASSERT_EQ(scene.environment.image.height, 8u);
    for (const glm::vec3& pixel : scene.environment.image.pixels)
        expect_near(pixel, {2.5f, 2.5f, 0.0f}, 1e-5f);
    EXPECT_EQ(scene.environment.radiance, glm::vec3(1.0f));
}

TEST(GltfImageBasedLight, PixelsWithoutAlphaAreLightUpToOne) {
    const auto gray = [](size_t, uint32_t, uint32_t) { return Pixel{128, 255, 0, 255}; };
    expect_near(radiance(lit_scene(2, gray), {1, 2, 3}),
                {std::pow(128.0f / 255.0f, 2.2f), 1.0f, 0.0f}, 1e-5f);
}

TEST(GltfImageBasedLight, EachFaceIsInItsDirection) {
    for (size_t face = 0; face < 6; ++face) {
        const Environment sky = read(lit_scene(8, one_red_face(face))).environment;
        for (size_t other = 0; other < 6; ++other) {
            const glm::vec3 expected(other == face ? 5.0f : 0.0f, 0.0f, 0.0f);
            expect_near(environment_radiance(sky, kFaceDirections[other]), expected, 1e-4f);
        }
    }
}

TEST(GltfImageBasedLight, TheFirstPixelOfEachFaceIsAtItsCorner) {
    // OpenGL 4.6, table 8.19 at s = -1 and t = 1, for images start with the last row; x mirrored.
    const std::array<glm::vec3, 6> corners{glm::vec3(-1, -1, 1), glm::vec3(1, -1, -1),
                                           glm::vec3(1, 1, 1),   glm::vec3(1, -1, -1),
                                           glm::vec3(1, -1, 1),  glm::vec3(-1, -1, -1)};
    for (size_t red = 0; red < 6; ++red) {
        const auto pixel_of = [red](size_t face, uint32_t column, uint32_t row) {
            return face == red && column < 4 && row < 4 ? kRed : kBlack;
        };
        const Environment sky = read(lit_scene(8, pixel_of)).environment;
        for (const float x : {-0.5f, 0.5f}) {
            for (const float y : {-0.5f, 0.5f}) {
                // The middle of a quarter of the face.
                const glm::vec3 forward = kFaceDirections[red];
                const glm::vec3 right(forward.y != 0 || forward.z != 0, 0, forward.x != 0);
                const glm::vec3 up(0, forward.y == 0, forward.y != 0);
                const glm::vec3 direction = forward + x * right + y * up;
                const bool is_lit = x * glm::dot(right, corners[red]) > 0.0f &&
                                    y * glm::dot(up, corners[red]) > 0.0f;
                expect_near(environment_radiance(sky, glm::normalize(direction)),
                            {is_lit ? 5.0f : 0.0f, 0, 0}, 0.02f);
            }
        }
    }
}

/// Light that differs along all axes: code 255 at +1 and 0 at -1, by channel.
Pixel smooth_pixel(size_t face, uint32_t column, uint32_t row, uint32_t size) {
    const double s = (2.0 * column + 1.0) / size - 1.0;
    const double t = 1.0 - (2.0 * row + 1.0) / size;
    const std::array<glm::dvec3, 6> texture{glm::dvec3(1, -t, -s), glm::dvec3(-1, -t, s),
                                            glm::dvec3(s, 1, t),   glm::dvec3(s, -1, -t),
                                            glm::dvec3(s, -t, 1),  glm::dvec3(-s, -t, -1)};
    const glm::dvec3 world = glm::normalize(texture[face] * glm::dvec3(-1, 1, 1));
    Pixel pixel{0, 0, 0, 255};
    for (int i = 0; i < 3; ++i) {
        const double light = 0.5 + 0.45 * world[i];
        pixel[static_cast<size_t>(i)] =
            static_cast<uint8_t>(std::lround(255.0 * std::pow(light, 1.0 / 2.2)));
    }
    return pixel;
}

glm::vec3 smooth_light(glm::vec3 direction) {
    return 0.5f + 0.45f * direction;
}

PixelOf smooth_cube(uint32_t size) {
    return [size](size_t face, uint32_t column, uint32_t row) {
        return smooth_pixel(face, column, row, size);
    };
}

TEST(GltfImageBasedLight, SmoothLightHasNoSeams) {
    const Environment sky = read(lit_scene(32, smooth_cube(32))).environment;
    for (int i = 0; i < 2000; ++i) {
        const double y = (i + 0.5) / 1000.0 - 1.0, angle = 2.4 * i, r = std::sqrt(1.0 - y * y);
        const glm::vec3 direction(r * std::cos(angle), y, r * std::sin(angle));
        // 1 / 510 of a code, times the slope of the curve, of three channels; and the filter.
        expect_near(environment_radiance(sky, direction), smooth_light(direction), 0.012f);
    }
    for (const float x : {-1.0f, 1.0f}) {
        for (const float z : {-1.0f, 1.0f}) {
            for (const float y : {-1.0f, 0.0f, 1.0f}) {
                const glm::vec3 corner = glm::normalize(glm::vec3(x, y, z));
                expect_near(environment_radiance(sky, corner), smooth_light(corner), 0.012f);
            }
        }
    }
}

TEST(GltfImageBasedLight, TheSkyHasTheLightOfTheCube) {
    // One texel near a corner of a face, brighter than any other: its solid angle is kept.
    const auto pixel_of = [](size_t face, uint32_t column, uint32_t row) {
        return face == 4 && column == 1 && row == 14 ? Pixel{255, 255, 255, 1} : kBlack;
    };
    const ImageF sky = read(lit_scene(16, pixel_of)).environment.image;
    double sum = 0.0;
    for (uint32_t row = 0; row < sky.height; ++row) {
        const double height =
            std::cos(kPi * row / sky.height) - std::cos(kPi * (row + 1) / sky.height);
        for (uint32_t column = 0; column < sky.width; ++column)
            sum += height * 2.0 * kPi / sky.width * sky.pixels[size_t{row} * sky.width + column].x;
    }
    const double s = 2.0 * 1.5 / 16.0 - 1.0;
    const double texel = (2.0 / 16.0) * (2.0 / 16.0) * std::pow(2.0 * s * s + 1.0, -1.5);
    EXPECT_NEAR(sum, 255.0 * texel, 0.05 * 255.0 * texel);
}

TEST(GltfImageBasedLight, IntensityIsAFactor) {
    EXPECT_EQ(read(lit_scene(2, one_red_face(2), {{"intensity", 3}})).environment.radiance,
              glm::vec3(3.0f));
    expect_near(radiance(lit_scene(8, one_red_face(2), {{"intensity", 3}}), {0, 1, 0}),
                {15.0f, 0.0f, 0.0f}, 1e-3f);
    EXPECT_EQ(read(lit_scene(2, one_red_face(2), {{"intensity", 0}})).environment, Environment{});
}

/// A turn about an axis, as glTF writes it.
Json turn(glm::dvec3 axis, double degrees) {
    const double half = degrees * kPi / 360.0;
    const glm::dvec3 v = std::sin(half) * glm::normalize(axis);
    return {v.x, v.y, v.z, std::cos(half)};
}

/// `v` turned about an axis, right-handed (Rodrigues).
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double degrees) {
    const glm::dvec3 k = glm::normalize(axis);
    const double angle = degrees * kPi / 180.0;
    return v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) +
           k * glm::dot(k, v) * (1.0 - std::cos(angle));
}

TEST(GltfImageBasedLight, RotationTurnsTheCubeInItsOwnFrame) {
    // The rotation turns the cube of the file, +X to -Z at 90 degrees about +Y; then x is mirrored.
    const GltfBuilder quarter =
        lit_scene(8, one_red_face(0), {{"rotation", turn({0, 1, 0}, 90.0)}});
    expect_near(radiance(quarter, {0, 0, -1}), {5, 0, 0}, 1e-3f);
    const GltfBuilder upwards =
        lit_scene(8, one_red_face(4), {{"rotation", turn({1, 0, 0}, -90.0)}});
    expect_near(radiance(upwards, {0, 1, 0}), {5, 0, 0}, 1e-3f);
    for (const glm::dvec3 axis : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
                                  glm::dvec3(0, 0, 1), glm::dvec3(1, -2, 0.5)}) {
        const Environment sky =
            read(lit_scene(32, smooth_cube(32), {{"rotation", turn(axis, 40.0)}})).environment;
        for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0.48, 0.64),
                                   glm::dvec3(-0.6, 0, 0.8), glm::dvec3(0, -0.8, -0.6)}) {
            const glm::dvec3 mirror(-1, 1, 1);
            const glm::dvec3 to = mirror * turned(mirror * d, axis, 40.0);
            expect_near(environment_radiance(sky, glm::vec3(to)), smooth_light(glm::vec3(d)),
                        0.015f);
        }
    }
}

TEST(GltfImageBasedLight, ATurnAboutTheVerticalKeepsTheImage) {
    const Environment plain = read(lit_scene(8, one_red_face(0))).environment;
    const Environment turned_sky =
        read(lit_scene(8, one_red_face(0), {{"rotation", turn({0, 1, 0}, 30.0)}})).environment;
    EXPECT_EQ(turned_sky.image, plain.image);
    EXPECT_NEAR(turned_sky.rotation_radians, -kPi / 6.0, 1e-6);
}

/// Coefficients of irradiance of the light 0.5 + 0.45 d in Babylon.js' basis, by numbers: the mean,
/// and the linear part of each channel with the cosine's factors pi and 2 pi / 3.
Json smooth_coefficients() {
    Json coefficients = Json::array();
    for (int i = 0; i < 9; ++i) coefficients.push_back({0.0, 0.0, 0.0});
    const double mean = kPi * 0.5 / 0.282094791773878;
    const double slope = 2.0 * kPi / 3.0 * 0.45 / 0.488602511902920;
    coefficients[0] = {mean, mean, mean};
    // In order y, z, x, where y and x have a minus, and x is mirrored besides.
    coefficients[1][1] = -slope;
    coefficients[2][2] = slope;
    coefficients[3][0] = slope;
    return coefficients;
}

/// A scene whose light has coefficients and no images.
GltfBuilder coefficient_scene(const Json& coefficients, const Json& members = {}) {
    Json light = {{"name", "studio"}, {"irradianceCoefficients", coefficients}};
    if (members.is_object()) light.update(members);
    return lit_by({}, light);
}

TEST(GltfImageBasedLight, WithoutImagesTheSkyIsThatOfTheCoefficients) {
    const Scene scene = read(coefficient_scene(smooth_coefficients()));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(
        scene.warnings[0].find("image-based sky (image-based light 0 \"studio\"): is that of "
                               "the irradianceCoefficients, without detail: it has no images"),
        std::string::npos)
        << scene.warnings[0];
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                 glm::vec3(0, 0, 1), glm::vec3(1, -1, 2)}) {
        const glm::vec3 direction = glm::normalize(axis);
        // At +Y one pixel answers, whose center is half a row of 2.8 degrees away.
        const float tolerance = axis.y == 1.0f ? 0.45f * std::sin(1.41f * 0.0175f) : 2e-3f;
        expect_near(environment_radiance(scene.environment, direction), smooth_light(direction),
                    tolerance);
    }
}

TEST(GltfImageBasedLight, CoefficientsTurnAsImagesDo) {
    for (const glm::dvec3 axis : {glm::dvec3(0, 1, 0), glm::dvec3(1, -2, 0.5)}) {
        const Json rotation = {{"rotation", turn(axis, 70.0)}};
        const Environment images = read(lit_scene(32, smooth_cube(32), rotation)).environment;
        const Environment smooth =
            read(coefficient_scene(smooth_coefficients(), rotation)).environment;
        for (const glm::vec3 d :
             {glm::vec3(1, 0, 0), glm::vec3(0, 0.6f, 0.8f), glm::vec3(-0.6f, -0.48f, 0.64f)}) {
            expect_near(environment_radiance(smooth, d), environment_radiance(images, d), 0.015f);
        }
    }
}

TEST(GltfImageBasedLight, RadianceOfCoefficientsIsNeverNegative) {
    // All light comes from above: L_i = Y_i(up), and E_i = A_l L_i.
    Json coefficients = Json::array();
    for (int i = 0; i < 9; ++i) coefficients.push_back({0.0, 0.0, 0.0});
    coefficients[0][0] = kPi * 0.282095;
    coefficients[1][0] = -2.0 * kPi / 3.0 * 0.488603;
    coefficients[6][0] = kPi / 4.0 * -0.315392;
    coefficients[8][0] = kPi / 4.0 * -0.546274;
    const Scene scene = read(coefficient_scene(coefficients));
    for (const glm::vec3& pixel : scene.environment.image.pixels) EXPECT_GE(pixel.x, 0.0f);
    // L(up) = (1 + 3 + 5) / 4 pi; L(-up) = (1 - 3 + 5) / 4 pi; at the horizon (1 - 5 / 2) / 4 pi.
    expect_near(environment_radiance(scene.environment, {0, 1, 0}), {9.0 / (4.0 * kPi), 0, 0},
                2e-3f);
    expect_near(environment_radiance(scene.environment, {0, -1, 0}), {3.0 / (4.0 * kPi), 0, 0},
                2e-3f);
    EXPECT_EQ(environment_radiance(scene.environment, {1, 0, 0}).x, 0.0f);
}

TEST(GltfImageBasedLight, ImagesOfUnknownFormatsLeaveTheCoefficients) {
    GltfBuilder gltf = lit_scene(4, smooth_cube(4));
    const size_t view = gltf.add_view<uint8_t>({0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb});
    gltf.json["images"][3]["bufferView"] = view;
    EXPECT_NE(gltf.error().find("image 3: "), std::string::npos) << gltf.error();
    gltf.json["extensions"][kExtension]["lights"][0]["irradianceCoefficients"] =
        smooth_coefficients();
    const Scene scene = read(gltf);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("without detail: "), std::string::npos);
    expect_near(environment_radiance(scene.environment, {0, 0, 1}), {0.5f, 0.5f, 0.95f}, 2e-3f);
}

/// The row of the extension in the table of what was read.
ScenePart row_of(const Scene& scene) {
    const auto found = std::ranges::find(scene.parts, kExtension, &ScenePart::name);
    return found == scene.parts.end() ? ScenePart() : *found;
}

TEST(GltfImageBasedLight, IsToldAsRead) {
    const Scene scene = read(lit_scene(4, smooth_cube(4)));
    EXPECT_EQ(row_of(scene).use, PartUse::Read);
    EXPECT_EQ(row_of(scene).count, 1u);
    const auto sky = std::ranges::find(scene.parts, "sky", &ScenePart::name);
    ASSERT_NE(sky, scene.parts.end());
    EXPECT_EQ(sky->elements, std::vector<std::string>{"image of 16 x 8"});
}

TEST(GltfImageBasedLight, TheSkyOfTheExtrasWins) {
    GltfBuilder gltf = lit_scene(4, smooth_cube(4));
    gltf.json["scenes"][0]["extras"]["sky"]["radiance"] = {1, 2, 3};
    const Scene scene = read(gltf);
    EXPECT_EQ(scene.environment, (Environment{{1, 2, 3}, {}, 0.0f}));
    EXPECT_EQ(row_of(scene).use, PartUse::Ignored);
    EXPECT_EQ(row_of(scene).note, "extras.sky of the scene is read instead");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfImageBasedLight, ALightThatIsNotTheSkyLightsNothing) {
    GltfBuilder gltf = lit_scene(4, smooth_cube(4), {{"extras", {{"sky", false}}}});
    const Scene scene = read(gltf);
    EXPECT_EQ(scene.environment, Environment{});
    EXPECT_EQ(row_of(scene).use, PartUse::Ignored);
    EXPECT_NE(row_of(scene).note.find("not its sky"), std::string::npos);
    EXPECT_TRUE(scene.warnings.empty());
    gltf.json["extensions"][kExtension]["lights"][0]["extras"]["sky"] = true;
    EXPECT_FALSE(read(gltf).environment.image.pixels.empty());
}

TEST(GltfImageBasedLight, OnlyTheLightOfTheSceneIsRead) {
    GltfBuilder gltf = lit_scene(4, smooth_cube(4));
    gltf.json["scenes"][0].erase("extensions");
    EXPECT_EQ(read(gltf).environment, Environment{});
}

TEST(GltfImageBasedLight, ErrorsNameTheLightAndTheValue) {
    const std::string place = "scene.glb: image-based light 0 \"studio\": ";
    const auto error = [](const Json& members) {
        return lit_scene(4, smooth_cube(4), members).error();
    };
    EXPECT_EQ(error({{"intensity", -1}}), place + "intensity -1 is negative or too large");
    EXPECT_EQ(error({{"intensity", 1e300}}), place + "intensity 1e+300 is negative or too large");
    EXPECT_EQ(error({{"rotation", {0, 0, 0, 0}}}), place + "rotation has a length of 0");
    Json coefficients = smooth_coefficients();
    coefficients[4][2] = -1e31;
    EXPECT_EQ(error({{"irradianceCoefficients", coefficients}}),
              place + "irradianceCoefficients[4][2] -1e+31 is not in the range -1e30 to 1e30");
    EXPECT_EQ(error({{"specularImages", Json::array()}}),
              place + "has no images, and not the nine irradianceCoefficients");
    GltfBuilder gltf = lit_scene(4, smooth_cube(4));
    Json& faces = gltf.json["extensions"][kExtension]["lights"][0]["specularImages"][0];
    faces[2] = add_image(gltf, {4, 2, std::vector<Pixel>(8, kBlack)});
    EXPECT_EQ(gltf.error(),
              place + "specularImages[0][2] has 4 x 2 texels; faces are squares of one size");
}

}  // namespace
}  // namespace tetralight
