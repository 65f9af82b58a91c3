// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_memory.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"
#include "tests/support/image_files.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMost = ~uint64_t{0};

/// The beginning of a PNG file, which has a size and no pixels.
std::vector<char> png_header(uint32_t width, uint32_t height) {
    const std::string file = test::png_file({.width = width, .height = height}, "");
    return {file.begin(), file.end()};
}

/// A triangle, and `count` images of this size with a material of its own each.
GltfBuilder with_images(size_t count, uint32_t width, uint32_t height) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    for (size_t i = 0; i < count; ++i) {
        gltf.add("images", {{"mimeType", "image/png"},
                            {"bufferView", gltf.add_view(png_header(width, height))}});
        gltf.add("textures", {{"source", i}});
        gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    }
    return gltf;
}

detail::GltfDocument document_of(const GltfBuilder& gltf) {
    const TempFolder folder;
    auto document = detail::read_gltf_document(folder.write("scene.glb", gltf.glb()));
    EXPECT_TRUE(document) << error_text(document.error());
    return document ? std::move(*document) : detail::GltfDocument();
}

uint64_t image_bytes(const GltfBuilder& gltf, NormalMaps normal_maps = NormalMaps::Skip) {
    return detail::image_memory(document_of(gltf), normal_maps);
}

TEST(GltfMemory, GeometryIsVerticesIndicesAndObjects) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const uint64_t none = document_of(gltf).memory.geometry_bytes;
    EXPECT_EQ(none, sizeof(Mesh) + 3 * sizeof(glm::vec3) + 3 * sizeof(uint32_t));

    gltf.primitive(mesh)["attributes"]["TEXCOORD_0"] = gltf.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
    EXPECT_EQ(document_of(gltf).memory.geometry_bytes, none + 3 * sizeof(glm::vec2));

    gltf.add_root({{"mesh", mesh}});
    EXPECT_EQ(document_of(gltf).memory.geometry_bytes,
              none + 3 * sizeof(glm::vec2) + sizeof(SceneNode) + sizeof(MeshInstance));
}

TEST(GltfMemory, NodesWithMorphTargetsHaveVerticesOfTheirOwn) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.add_root({{"mesh", mesh}});
    gltf.add_root({{"mesh", mesh}});
    const uint64_t plain = document_of(gltf).memory.geometry_bytes;
    gltf.primitive(mesh)["targets"] =
        Json::array({{{"POSITION", gltf.primitive(mesh)["attributes"]["POSITION"]}}});
    EXPECT_EQ(document_of(gltf).memory.geometry_bytes,
              plain + 2 * (sizeof(Mesh) + 3 * sizeof(glm::vec3) + 3 * sizeof(uint32_t)));
}

TEST(GltfMemory, EveryInstanceOfAnObjectCounts) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    gltf.add_root({{"mesh", mesh}});
    const uint64_t one = document_of(gltf).memory.geometry_bytes;
    const size_t places = gltf.add_floats(std::vector<float>(300, 1.0f), "VEC3");
    gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        places;
    EXPECT_EQ(document_of(gltf).memory.geometry_bytes, one + 99 * sizeof(MeshInstance));
}

TEST(GltfMemory, ImagesHaveFourBytesATexel) {
    EXPECT_EQ(image_bytes(with_images(0, 1, 1)), 0u);
    EXPECT_EQ(image_bytes(with_images(1, 300, 200)), 4u * 300 * 200);
    EXPECT_EQ(image_bytes(with_images(3, 300, 200)), 3u * 4 * 300 * 200);
}

TEST(GltfMemory, ImagesThatShareBytesCountOnce) {
    GltfBuilder gltf = with_images(3, 300, 200);
    for (Json& image : gltf.json["images"])
        image["bufferView"] = gltf.json["images"][0]["bufferView"];
    EXPECT_EQ(image_bytes(gltf), 4u * 300 * 200);
    gltf.add("samplers", {{"wrapS", 33071}});
    gltf.json["textures"][1]["sampler"] = 0;  // a texture of its own
    EXPECT_EQ(image_bytes(gltf), 2u * 4 * 300 * 200);
}

TEST(GltfMemory, ImagesThatAreNotDecodedDoNotCount) {
    GltfBuilder gltf = with_images(1, 300, 200);
    Json& material = gltf.json["materials"][0];
    material["normalTexture"] = {{"index", 0}};
    EXPECT_EQ(image_bytes(gltf), 4u * 300 * 200);
    EXPECT_EQ(image_bytes(gltf, NormalMaps::Read), 2u * 4 * 300 * 200);
    material.erase("pbrMetallicRoughness");
    EXPECT_EQ(image_bytes(gltf), 0u);
    material["emissiveTexture"] = {{"index", 0}};  // times an emission of 0
    EXPECT_EQ(image_bytes(gltf), 0u);
    material["emissiveFactor"] = {0, 0, 1};
    EXPECT_EQ(image_bytes(gltf), 4u * 300 * 200);
}

TEST(GltfMemory, RefusesHugeImagesBeforeItDecodesThem) {
    constexpr size_t kCount = 2000;
    const std::string error = with_images(kCount, 16384, 16384).error();
    // 4 * 16384 * 16384 * 2000 bytes; the images have no pixels, which decoding would refuse.
    EXPECT_TRUE(
        error.starts_with("scene.glb: reading it needs about 2147.5 GB of memory "
                          "(geometry 0 GB, images 2147.5 GB), "))
        << error;
    EXPECT_TRUE(error.ends_with(" GB are free")) << error;
}

TEST(GltfMemory, OnlyElementsThatCanBeThereCount) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    gltf.json["accessors"][0]["count"] = 4'000'000'000;
    EXPECT_NE(gltf.error().find("are outside of buffer view 0 (36 bytes)"), std::string::npos)
        << gltf.error();
    gltf.json["accessors"][0].erase("bufferView");
    EXPECT_NE(gltf.error().find("elements without a buffer view are more than 1048576"),
              std::string::npos)
        << gltf.error();
}

TEST(GltfMemory, BuffersAndEitherTheFileOrTheSceneAreThereAtOneTime) {
    const SceneMemory memory{100, 1000, 20, 30};
    EXPECT_EQ(memory.scene_bytes(), 50u);
    EXPECT_EQ(memory.peak_bytes(), 1100u);
    EXPECT_EQ((SceneMemory{100, 1000, 200, 30}.peak_bytes()), 1230u);
    EXPECT_EQ((SceneMemory{0, kMost, 1, 1}.peak_bytes()), kMost);
}

TEST(GltfMemory, ChecksThePeak) {
    const SceneMemory memory{0, 3'000'000'000, 1'000'000'000, 4'000'000'000};
    EXPECT_TRUE(detail::check_reading_memory(memory, 8'000'000'000));
    const auto refused = detail::check_reading_memory(memory, 7'900'000'000);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfResources);
    EXPECT_EQ(
        error_text(refused.error()),
        "reading it needs about 8 GB of memory (geometry 4 GB, images 4 GB), 7.9 GB are free");
}

}  // namespace
}  // namespace tetralight
