// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/image_based_light_glb.h>

#include <gtest/gtest.h>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

const char* const kExtension = "EXT_lights_image_based";

/// Bytes that say which image they stand for; of lengths that do not keep views aligned.
std::vector<std::byte> image_bytes(size_t level, size_t face) {
    return std::vector<std::byte>(10 * level + face + 1, static_cast<std::byte>(10 * level + face));
}

GltfImageBasedLight two_levels() {
    GltfImageBasedLight light;
    light.name = "hall";
    light.intensity = 4.0f;
    light.is_sky = false;
    light.size = 16;
    for (size_t i = 0; i < 9; ++i) light.irradiance_coefficients[i] = glm::vec3(i, -1, 0.5f);
    for (size_t level = 0; level < 2; ++level) {
        auto& faces = light.levels.emplace_back();
        for (size_t face = 0; face < 6; ++face) faces[face] = image_bytes(level, face);
    }
    return light;
}

/// A triangle in the second of two scenes, which is the default one, and a light for the other.
GltfBuilder two_scenes() {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t image = gltf.add(
        "images", {{"mimeType", "image/png"}, {"bufferView", gltf.add_view<uint8_t>({7, 7, 7})}});
    const Json old = {{"irradianceCoefficients", Json::array()},
                      {"specularImageSize", 1},
                      {"specularImages", {{image, image, image, image, image, image}}}};
    gltf.add("nodes", {{"mesh", mesh}, {"name", "wall"}});
    gltf.json["scenes"] = {{{"extensions", {{kExtension, {{"light", 0}}}}}},
                           {{"nodes", {0}}, {"extras", {{"floor", 3}}}}};
    gltf.json["scene"] = 1;
    gltf.json["extensions"] = {{kExtension, {{"lights", Json::array({old})}}},
                               {"OTHER_kept", {{"a", 1}}}};
    gltf.json["extensionsUsed"] = {"OTHER_kept", kExtension};
    return gltf;
}

struct Written {
    Json json;
    std::string binary;
    Scene scene;
};

Written written(const GltfBuilder& gltf, const GltfImageBasedLight& light = two_levels()) {
    const TempFolder folder;
    const auto bytes = make_image_based_light_glb(folder.write("scene.glb", gltf.glb()), light);
    EXPECT_TRUE(bytes) << (bytes ? "" : error_text(bytes.error()));
    if (!bytes) return {};
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    uint32_t length = 0;
    std::memcpy(&length, text.data() + 12, sizeof length);
    auto scene = read_gltf(folder.write("written.glb", text));
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return {Json::parse(text.substr(20, length)), text.substr(20 + length + 8),
            scene ? std::move(*scene) : Scene{}};
}

Error refusal(const GltfBuilder& gltf) {
    const TempFolder folder;
    const auto bytes =
        make_image_based_light_glb(folder.write("scene.glb", gltf.glb()), two_levels());
    return bytes ? Error{} : bytes.error();
}

/// The message from behind the folder's name.
std::string message_of(const Error& error) {
    const std::string& text = error_text(error);
    return text.substr(std::min(text.find("scene.glb"), text.size()));
}

TEST(ImageBasedLightGlb, TheLightHasTheMembersOfTheExtension) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    const Json json = written(gltf).json;
    EXPECT_EQ(json["extensionsUsed"], Json::array({kExtension}));
    EXPECT_FALSE(json.contains("extensionsRequired"));
    EXPECT_EQ(json["scenes"][0]["extensions"][kExtension], Json::object({{"light", 0}}));
    ASSERT_EQ(json["extensions"][kExtension]["lights"].size(), 1u);
    const Json& light = json["extensions"][kExtension]["lights"][0];
    EXPECT_EQ(light["name"], "hall");
    EXPECT_EQ(light["intensity"], 4.0);
    EXPECT_EQ(light["specularImageSize"], 16);
    ASSERT_EQ(light["irradianceCoefficients"].size(), 9u);
    for (size_t i = 0; i < 9; ++i)
        EXPECT_EQ(light["irradianceCoefficients"][i], Json({static_cast<double>(i), -1.0, 0.5}));
    ASSERT_EQ(light["specularImages"].size(), 2u);
    for (const Json& faces : light["specularImages"]) EXPECT_EQ(faces.size(), 6u);
}

TEST(ImageBasedLightGlb, ALightThatIsNotTheSkySaysSo) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    GltfImageBasedLight light = two_levels();
    for (const bool is_sky : {false, true}) {
        light.is_sky = is_sky;
        const Json json = written(gltf, light).json["extensions"][kExtension]["lights"][0];
        EXPECT_EQ(json.value("extras", Json()), is_sky ? Json() : Json({{"sky", false}}));
    }
}

TEST(ImageBasedLightGlb, ItsImagesAreInTheFile) {
    const Written result = written(two_scenes());
    const Json& light = result.json["extensions"][kExtension]["lights"][1];
    for (size_t level = 0; level < 2; ++level) {
        for (size_t face = 0; face < 6; ++face) {
            const size_t index = light["specularImages"][level][face];
            const Json& image = result.json["images"].at(index);
            EXPECT_EQ(image["mimeType"], "image/png");
            const Json& view = result.json["bufferViews"].at(image["bufferView"].get<size_t>());
            const auto expected = image_bytes(level, face);
            EXPECT_EQ(view["byteOffset"].get<size_t>() % 4, 0u);
            EXPECT_EQ(result.binary.substr(view["byteOffset"], view["byteLength"]),
                      std::string(reinterpret_cast<const char*>(expected.data()), expected.size()));
        }
    }
    EXPECT_EQ(result.json["buffers"].size(), 1u);
    EXPECT_LE(result.json["buffers"][0]["byteLength"].get<size_t>(), result.binary.size());
}

TEST(ImageBasedLightGlb, TheDefaultSceneUsesItAndEverythingElseStays) {
    const GltfBuilder before = two_scenes();
    const Written after = written(before);
    Json scenes = before.json["scenes"];
    scenes[1]["extensions"][kExtension]["light"] = 1;
    EXPECT_EQ(after.json["scenes"], scenes);
    EXPECT_EQ(after.json["scene"], 1);
    EXPECT_EQ(after.json["nodes"], before.json["nodes"]);
    EXPECT_EQ(after.json["meshes"], before.json["meshes"]);
    EXPECT_EQ(after.json["accessors"], before.json["accessors"]);
    EXPECT_EQ(after.json["images"][0], before.json["images"][0]);
    EXPECT_EQ(after.json["extensions"]["OTHER_kept"], before.json["extensions"]["OTHER_kept"]);
    EXPECT_EQ(after.json["extensions"][kExtension]["lights"][0],
              before.json["extensions"][kExtension]["lights"][0]);
    EXPECT_EQ(after.json["extensionsUsed"], before.json["extensionsUsed"]);
    const Scene scene = *before.read();
    ASSERT_EQ(after.scene.instances.size(), 1u);
    EXPECT_EQ(after.scene.instances[0].name, "wall");
    EXPECT_EQ(after.scene.meshes[0].positions, scene.meshes[0].positions);
}

TEST(ImageBasedLightGlb, ASceneThatHadTheLightGetsTheNewOne) {
    GltfBuilder gltf = two_scenes();
    gltf.json["scene"] = 0;
    const Json json = written(gltf).json;
    EXPECT_EQ(json["scenes"][0]["extensions"][kExtension]["light"], 1);
    EXPECT_FALSE(json["scenes"][1].contains("extensions"));
}

TEST(ImageBasedLightGlb, MembersOfAnotherTypeAreNamed) {
    GltfBuilder gltf = two_scenes();
    gltf.json["extensions"][kExtension]["lights"] = 5;
    Error error = refusal(gltf);
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    EXPECT_EQ(error.field, "extensions.EXT_lights_image_based.lights");
    EXPECT_EQ(error.value, "5");
    EXPECT_EQ(message_of(error), "scene.glb: lights is not an array (5)");

    gltf = two_scenes();
    gltf.json["extensions"][kExtension] = "none";
    error = refusal(gltf);
    EXPECT_EQ(error.field, "extensions.EXT_lights_image_based");
    EXPECT_EQ(message_of(error),
              "scene.glb: extensions/EXT_lights_image_based is not an object (\"none\")");

    gltf = two_scenes();
    gltf.json["scenes"][1]["extensions"] = {{kExtension, 7}};
    error = refusal(gltf);
    EXPECT_EQ(error.field, "scenes[1].extensions.EXT_lights_image_based");
    EXPECT_EQ(message_of(error),
              "scene.glb: scene 1: extensions/EXT_lights_image_based is not an object (7)");
}

TEST(ImageBasedLightGlb, ThereHasToBeAScene) {
    GltfBuilder gltf;
    gltf.add("nodes", {{"mesh", gltf.add_triangle()}});
    const Error error = refusal(gltf);
    EXPECT_EQ(error.code, ErrorCode::InvalidArgument);
    EXPECT_EQ(error.field, "scenes");
    EXPECT_EQ(message_of(error), "scene.glb: has no scene that could use an image-based light");
    const auto missing = make_image_based_light_glb("no such.glb", two_levels());
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
}

TEST(ImageBasedLightGlb, NeedsNoScene) {
    const auto bytes = make_image_based_light_glb(two_levels());
    ASSERT_TRUE(bytes);
    const TempFolder folder;
    const auto scene = read_gltf(folder.write(
        "light.glb", std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())));
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->instances.empty());
}

/// Babylon.js' world has x mirrored, and images start with the last row.
TEST(ImageBasedLightGlb, DirectionsAreThoseOfBabylon) {
    const auto expect = [](uint32_t face, uint32_t x, uint32_t y, const glm::vec3& direction) {
        const glm::vec3 d = image_based_light_direction(face, x, y, 2);
        EXPECT_LT(glm::distance(d, glm::normalize(direction)), 1e-6f) << face;
    };
    // Texel (0, 0) of face +X looks to (1, ½, ½) there: (-1, ½, ½) here, in row 1 of the image.
    expect(0, 0, 1, {-1, 0.5, 0.5});
    expect(1, 0, 1, {1, 0.5, -0.5});
    expect(2, 0, 1, {0.5, 1, -0.5});
    expect(4, 1, 0, {-0.5, -0.5, 1});
}

}  // namespace
}  // namespace tetralight
