// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_document.h>

#include <gtest/gtest.h>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

/// A small scene with something of everything.
GltfBuilder whole_scene() {
    GltfBuilder gltf;
    const TempFolder folder;
    EXPECT_TRUE(write_png(folder.path("a.png"), Image8{1, 1, {{1, 2, 3, 255}}}));
    const size_t mesh = gltf.add_triangle();
    gltf.primitive(mesh)["indices"] =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 2}, "SCALAR", 5123);
    gltf.primitive(mesh)["attributes"]["TEXCOORD_0"] = gltf.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
    gltf.primitive(mesh)["material"] =
        gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                               {"emissiveFactor", {1, 1, 1}},
                               {"emissiveTexture", {{"index", 0}}}});
    gltf.add("textures", {{"source", 0}, {"sampler", 0}});
    gltf.add("samplers", {{"wrapS", 33071}});
    gltf.add("images", {{"bufferView", gltf.add_view(*read_file(folder.path("a.png")))},
                        {"mimeType", "image/png"}});
    const size_t light = gltf.add_light({{"type", "point"}});
    const size_t child = gltf.add("nodes", {{"extensions", GltfBuilder::light_extension(light)}});
    const Json instancing = {{"TRANSLATION", gltf.add_floats({0, 0, 0, 1, 1, 1}, "VEC3")}};
    gltf.add_root({{"mesh", mesh},
                   {"children", {child}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", instancing}}}}}});
    return gltf;
}

/// The message for a file of these bytes, from behind the folder's name.
std::string error_of(const std::string& bytes, const std::string& name = "scene.glb") {
    const TempFolder folder;
    const auto scene = read_gltf(folder.write(name, bytes));
    if (scene) return "(no error)";
    const std::string& message = error_text(scene.error());
    return message.substr(std::min(message.find(name), message.size()));
}

TEST(GltfDocument, WholeSceneIsRead) {
    const auto scene = whole_scene().read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->instances.size(), 2u);
    EXPECT_EQ(scene->lights.size(), 1u);
    EXPECT_EQ(scene->textures.size(), 1u);
    EXPECT_TRUE(scene->warnings.empty());
}

TEST(GltfDocument, EveryTruncationIsAnError) {
    const std::string whole = whole_scene().glb();
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::string error = error_of(whole.substr(0, length));
        ASSERT_TRUE(error.starts_with("scene.glb: ")) << length << ": " << error;
    }
}

TEST(GltfDocument, TruncationsThatFixTheLengthAreErrorsToo) {
    const std::string whole = whole_scene().glb();
    for (size_t length = 12; length < whole.size(); ++length) {
        std::string cut = whole.substr(0, length);
        cut.replace(8, 4, GltfBuilder::u32(length));
        ASSERT_TRUE(error_of(cut).starts_with("scene.glb: ")) << length;
    }
}

TEST(GltfDocument, NoFlippedByteCrashes) {
    const std::string whole = whole_scene().glb();
    const TempFolder folder;
    for (size_t i = 0; i < whole.size(); ++i) {
        for (const char flip : {'\x01', '\x10', '\xff'}) {
            std::string bytes = whole;
            bytes[i] = static_cast<char>(bytes[i] ^ flip);
            const auto scene = read_gltf(folder.write("scene.glb", bytes));
            EXPECT_TRUE(scene || !error_text(scene.error()).empty());
        }
    }
}

TEST(GltfDocument, BinaryFilesOfGltf1AreAnErrorThatSaysWhatToDo) {
    std::string bytes = whole_scene().glb();
    bytes[4] = 1;
    EXPECT_EQ(error_of(bytes),
              "scene.glb: GLB version 1 is not supported (2 is); `gltf-pipeline -i IN.glb -o "
              "OUT.glb` makes it glTF 2.0");
    bytes[4] = 3;
    EXPECT_EQ(error_of(bytes), "scene.glb: GLB version 3 is not supported (2 is)");
}

TEST(GltfDocument, ChunkThatClaimsAFewBytesTooManyIsAnError) {
    GltfBuilder gltf;
    gltf.add_triangle();
    std::string bytes = gltf.glb();
    const size_t chunk = bytes.size() - 36 - 8;
    bytes.replace(chunk, 4, GltfBuilder::u32(36 + 4));
    EXPECT_EQ(error_of(bytes), "scene.glb: is cut off: the chunk at byte " + std::to_string(chunk) +
                                   " has 40 bytes, 36 are left");
}

TEST(GltfDocument, ReadsTextWithAnExternalBuffer) {
    const TempFolder folder;
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}});
    gltf.json["buffers"] = {{{"uri", "data%201.bin"}, {"byteLength", gltf.binary.size()}}};
    folder.write("data 1.bin", gltf.binary);
    const auto scene = read_gltf(folder.write("scene.gltf", gltf.json.dump()));
    ASSERT_TRUE(scene) << error_text(scene.error());
    EXPECT_EQ(scene->meshes[0].positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfDocument, ReadsTextWithADataUri) {
    GltfBuilder gltf;
    gltf.add_triangle();
    // 36 zero bytes.
    gltf.json["buffers"] = {
        {{"uri", "data:application/octet-stream;base64," + std::string(48, 'A')},
         {"byteLength", 36}}};
    EXPECT_EQ(error_of(gltf.json.dump(), "scene.gltf"), "(no error)");
}

TEST(GltfDocument, NamesABufferFileThatIsMissing) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["buffers"] = {{{"uri", "missing.bin"}, {"byteLength", 36}}};
    const std::string error = error_of(gltf.json.dump(), "scene.gltf");
    EXPECT_TRUE(error.starts_with("scene.gltf: ")) << error;
    EXPECT_NE(error.find("missing.bin: cannot open (No such file or directory)"), std::string::npos)
        << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(GltfDocument, BufferFileThatIsTooShortIsAnError) {
    const TempFolder folder;
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["buffers"] = {{{"uri", "short.bin"}, {"byteLength", 36}}};
    folder.write("short.bin", "only this");
    const auto scene = read_gltf(folder.write("scene.gltf", gltf.json.dump()));
    ASSERT_FALSE(scene);
    EXPECT_NE(error_text(scene.error())
                  .find("scene.gltf: buffer 0: byteLength is 36, short.bin has 9 bytes"),
              std::string::npos)
        << error_text(scene.error());
}

TEST(GltfDocument, RejectsPathsOutOfTheFolder) {
    for (const char* uri : {"/etc/hostname", "../data.bin", "%2e%2e/data.bin", "file:data.bin"}) {
        GltfBuilder gltf;
        gltf.add_triangle();
        gltf.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        EXPECT_EQ(error_of(gltf.json.dump(), "scene.gltf"),
                  std::string("scene.gltf: buffer 0: uri \"") + uri +
                      "\" is not a path below the scene's folder");
    }
}

TEST(GltfDocument, MissingFileIsNamed) {
    const auto scene = read_gltf("/nowhere/scene.glb");
    ASSERT_FALSE(scene);
    EXPECT_EQ(error_text(scene.error()),
              "/nowhere/scene.glb: cannot open (No such file or directory)");
}

}  // namespace
}  // namespace tetralight
