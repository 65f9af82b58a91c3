// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_textures.h>

#include <gtest/gtest.h>

#include <numbers>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

const Image8 kImage{2, 1, {{255, 0, 0, 255}, {0, 128, 255, 64}}};

std::vector<std::byte> png_bytes() {
    const TempFolder folder;
    EXPECT_TRUE(write_png(folder.path("a.png"), kImage));
    return *read_file(folder.path("a.png"));
}

/// A scene whose one material has texture 0, which shows `image`, as its base colour.
GltfBuilder textured(Json image) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.add("images", std::move(image));
    gltf.add("textures", {{"source", 0}});
    gltf.primitive(mesh)["material"] =
        gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    gltf.add_root({{"mesh", mesh}});
    return gltf;
}

GltfBuilder with_embedded_png() {
    GltfBuilder gltf = textured({{"name", "bricks"}, {"mimeType", "image/png"}});
    gltf.json["images"][0]["bufferView"] = gltf.add_view(png_bytes());
    return gltf;
}

Json& base_color_texture(GltfBuilder& gltf) {
    return gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

Scene scene_of(const GltfBuilder& gltf) {
    auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? std::move(*scene) : Scene{};
}

TEST(GltfTextures, DecodesAnEmbeddedPng) {
    const Scene scene = scene_of(with_embedded_png());
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].image, kImage);
    EXPECT_EQ(scene.textures[0].name, "bricks");
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, 0u);
}

TEST(GltfTextures, ReadsAFileBesideTheScene) {
    const TempFolder folder;
    const GltfBuilder gltf = textured({{"uri", "red%20bricks.png"}});
    ASSERT_TRUE(write_png(folder.path("red bricks.png"), kImage));
    const auto scene = read_gltf(folder.write("scene.glb", gltf.glb()));
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->textures[0].image, kImage);
}

TEST(GltfTextures, DecodesADataUri) {
    // A PNG of one white pixel, by `base64`; it has a palette of one bit.
    const GltfBuilder gltf = textured(
        {{"uri",
          "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/5+h"
          "HgAHggJ/PchI7wAAAABJRU5ErkJggg=="}});
    const Scene scene = scene_of(gltf);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].image.width, 1u);
}

TEST(GltfTextures, SamplerSetsTheWrapModes) {
    GltfBuilder gltf = with_embedded_png();
    gltf.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    gltf.json["textures"][0]["sampler"] = 0;
    const Scene scene = scene_of(gltf);
    EXPECT_EQ(scene.textures[0].wrap_u, TextureWrap::ClampToEdge);
    EXPECT_EQ(scene.textures[0].wrap_v, TextureWrap::MirroredRepeat);
}

TEST(GltfTextures, SameImageAndWrapIsDecodedOnce) {
    GltfBuilder gltf = with_embedded_png();
    gltf.add("textures", {{"source", 0}});
    gltf.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
    gltf.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
    const Scene scene = scene_of(gltf);
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].emission_texture.texture, 0u);
}

TEST(GltfTextures, ImagesThatShareTheirBytesAreDecodedOnce) {
    GltfBuilder gltf = with_embedded_png();
    gltf.json["images"][1] = gltf.json["images"][0];
    gltf.json["images"][1]["name"] = "the same bricks";
    gltf.add("textures", {{"source", 1}});
    gltf.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
    gltf.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
    const Scene scene = scene_of(gltf);
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].emission_texture.texture, 0u);
    // Other bytes, another texture.
    gltf.json["images"][1]["bufferView"] = gltf.add_view(png_bytes());
    EXPECT_EQ(scene_of(gltf).textures.size(), 2u);
}

TEST(GltfTextures, BasisUniversalIsReadByItsFallbackOrRefused) {
    GltfBuilder gltf = with_embedded_png();
    const size_t view = gltf.add_view(std::vector<uint8_t>{0xab, 'K', 'T', 'X'});
    gltf.add("images", {{"bufferView", view}, {"mimeType", "image/ktx2"}});
    gltf.json["extensionsRequired"] = {"KHR_texture_basisu"};
    gltf.json["textures"][0]["extensions"]["KHR_texture_basisu"] = {{"source", 1}};
    EXPECT_EQ(scene_of(gltf).textures.at(0).image, kImage);
    gltf.json["textures"][0].erase("source");
    EXPECT_EQ(gltf.error(),
              "scene.glb: material 0: baseColorTexture: texture 0: has only a Basis Universal "
              "image (KHR_texture_basisu), which is not read; `gltf-transform ktxdecompress` makes "
              "it a PNG image");
}

TEST(GltfTextures, TheWebPImageOfATextureIsRead) {
    GltfBuilder gltf = with_embedded_png();
    gltf.json["textures"][0]["extensions"]["EXT_texture_webp"] = {{"source", 0}};
    gltf.json["textures"][0]["source"] = gltf.add("images", {{"uri", "missing.png"}});
    EXPECT_EQ(scene_of(gltf).textures.size(), 1u);
    gltf.json["textures"][0].erase("source");
    EXPECT_EQ(scene_of(gltf).textures.size(), 1u);
}

TEST(GltfTextures, ImagesThatNothingUsesAreNotDecoded) {
    GltfBuilder gltf = with_embedded_png();
    gltf.add("images", {{"uri", "missing.png"}});
    gltf.add("textures", {{"source", 1}});
    gltf.json["materials"][0]["normalTexture"] = {{"index", 1}};
    gltf.json["materials"][0]["emissiveTexture"] = {{"index", 1}};  // of no emission
    EXPECT_EQ(scene_of(gltf).textures.size(), 1u);
}

TEST(GltfTextures, NormalMapsAreReadIfAskedFor) {
    GltfBuilder gltf = with_embedded_png();
    gltf.json["materials"][0]["normalTexture"] = {
        {"index", 0},
        {"texCoord", 1},
        {"scale", -0.5},
        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}}}}}};
    EXPECT_TRUE(scene_of(gltf).normal_maps.empty());
    const auto scene = gltf.read({.normal_maps = NormalMaps::Read});
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->textures.size(), 1u);
    ASSERT_EQ(scene->normal_maps.size(), 1u);
    EXPECT_EQ(scene->normal_maps[0].image, kImage);
    const Material& material = scene->materials[0];
    EXPECT_EQ(material.normal_texture.texture, 0u);
    EXPECT_EQ(material.normal_texture.uv_set, 1u);
    EXPECT_EQ(material.normal_texture.image_from_mesh[2], glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(material.normal_scale, -0.5f);
}

TEST(GltfTextures, NamesWhatIsWrongWithANormalMap) {
    GltfBuilder gltf = with_embedded_png();
    const auto error_with = [&](Json map) {
        gltf.json["materials"][0]["normalTexture"] = std::move(map);
        return gltf.error({.normal_maps = NormalMaps::Read});
    };
    EXPECT_EQ(error_with({{"index", 0}, {"scale", 1e39}}),
              "scene.glb: material 0: normalTexture: scale 1e+39 is too large");
    EXPECT_EQ(error_with({{"index", 0}, {"texCoord", 2}}),
              "scene.glb: material 0: normalTexture: texCoord 2 is not supported (0 and 1 are)");
    EXPECT_EQ(error_with({{"index", 1}}),
              "scene.glb: material 0: normalTexture/index 1 is out of range (1 textures)");
}

TEST(GltfTextures, TextureWithoutSourceIsLeftOutWithAWarning) {
    GltfBuilder gltf = with_embedded_png();
    gltf.json["textures"][0] = {{"extensions", {{"EXT_texture_avif", {{"source", 0}}}}}};
    const Scene scene = scene_of(gltf);
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, kNoIndex);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with(
        "textures without image (texture 0): have no PNG, JPEG or WebP image; left out"));
}

TEST(GltfTextures, TransformMovesTurnsAndScales) {
    GltfBuilder gltf = with_embedded_png();
    base_color_texture(gltf)["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 4}}};
    const Scene scene = scene_of(gltf);
    const glm::mat3& image_from_mesh = scene.materials[0].base_color_texture.image_from_mesh;
    // Scale first: (0.1, 0.2) to (0.2, 0.8). A quarter turn that looks counter-clockwise where v
    // runs downwards takes (u, v) to (v, -u): (0.8, -0.2). Then the offset.
    const glm::vec3 uv = image_from_mesh * glm::vec3(0.1f, 0.2f, 1.0f);
    EXPECT_NEAR(uv.x, 1.3f, 1e-6f);
    EXPECT_NEAR(uv.y, 0.05f, 1e-6f);
}

TEST(GltfTextures, TransformMayChooseTheUvSet) {
    GltfBuilder gltf = with_embedded_png();
    base_color_texture(gltf)["texCoord"] = 0;
    base_color_texture(gltf)["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(scene_of(gltf).materials[0].base_color_texture.uv_set, 1u);
}

TEST(GltfTextures, RejectsAUvSetThatIsNotRead) {
    GltfBuilder gltf = with_embedded_png();
    base_color_texture(gltf)["texCoord"] = 2;
    EXPECT_EQ(gltf.error(),
              "scene.glb: material 0: baseColorTexture: texCoord 2 is not supported (0 and 1 are)");
}

TEST(GltfTextures, RejectsAnUnknownWrapMode) {
    GltfBuilder gltf = with_embedded_png();
    gltf.add("samplers", {{"wrapS", 10498}});
    gltf.json["textures"][0]["sampler"] = 0;
    EXPECT_EQ(gltf.error(),
              "scene.glb: material 0: baseColorTexture: texture 0: sampler 0: wrapS 10498 is not a "
              "wrap mode");
}

TEST(GltfTextures, RejectsATransformThatOverflows) {
    GltfBuilder gltf = with_embedded_png();
    base_color_texture(gltf)["extensions"]["KHR_texture_transform"]["offset"] = {1e300, 0};
    EXPECT_EQ(gltf.error(),
              "scene.glb: material 0: baseColorTexture: KHR_texture_transform is not finite");
}

TEST(GltfTextures, NamesAnImageFileThatIsMissing) {
    const std::string error = textured({{"uri", "missing.png"}, {"name", "bricks"}}).error();
    EXPECT_TRUE(error.starts_with(
        "scene.glb: material 0: baseColorTexture: texture 0: image 0 \"bricks\": "))
        << error;
    EXPECT_NE(error.find("missing.png: cannot open (No such file or directory)"), std::string::npos)
        << error;
}

TEST(GltfTextures, NamesAnImageThatCannotBeDecoded) {
    GltfBuilder gltf = textured({{"name", "bricks"}});
    gltf.json["images"][0]["bufferView"] = gltf.add_view(std::vector<char>{'n', 'o'});
    EXPECT_EQ(
        gltf.error(),
        "scene.glb: material 0: baseColorTexture: texture 0: image 0 \"bricks\": is neither a "
        "PNG nor a JPEG nor a WebP image");
}

}  // namespace
}  // namespace tetralight
