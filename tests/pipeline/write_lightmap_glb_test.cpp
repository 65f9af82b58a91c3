// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_lightmap_glb.h>

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// The positions of a cube, and the indices of its triangles.
std::string box_bytes() {
    std::vector<float> positions;
    std::vector<uint16_t> indices;
    for (int i = 0; i < 8; ++i) {
        for (const int bit : {1, 2, 4}) positions.push_back((i & bit) != 0 ? 1.0f : 0.0f);
    }
    for (const auto& [a, b, c, d] : {std::array<uint16_t, 4>{0, 2, 3, 1},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 4, 6, 2},
                                     {1, 3, 7, 5}}) {
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
    std::string binary(reinterpret_cast<const char*>(positions.data()), positions.size() * 4);
    binary.append(reinterpret_cast<const char*>(indices.data()), indices.size() * 2);
    return binary;
}

/// Two boxes of one mesh, one of them stretched.
nlohmann::json boxes_json() {
    return nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": "cube", "mesh": 0},
                  {"name": "wall", "mesh": 0, "translation": [5, 0, 0], "scale": [3, 2, 0.5]}],
        "meshes": [{"name": "box", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96},
                        {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"uri": "boxes.bin", "byteLength": 168}]})");
}

class WriteLightmapGlb : public testing::Test {
  protected:
    WriteLightmapGlb() {
        folder_.write("boxes.bin", box_bytes());
        path_ = folder_.write("boxes.gltf", boxes_json().dump());
        scene_ = *read_gltf(path_);
    }

    [[nodiscard]] LightmapLayoutSettings settings(LightmapUvs uvs = LightmapUvs::Unwrap) const {
        LightmapLayoutSettings settings;
        settings.texels_per_meter = 4;
        settings.page_size = 64;
        settings.uvs = uvs;
        return settings;
    }

    [[nodiscard]] Lightmaps bake() const {
        BakeLightmapsSettings bake;
        bake.layout = settings();
        bake.bake.sample_count = 4;
        Scene lit = scene_;
        lit.environment.radiance = glm::vec3(1.0f);
        return bake_lightmaps(lit, bake)->lightmaps;
    }

    [[nodiscard]] std::string refusal(const Scene& scene, const Lightmaps& maps) const {
        const auto status = write_lightmap_glb(folder_.path("no.glb"), path_, scene, maps.view());
        return status ? "(no error)" : error_text(status.error());
    }

    TempFolder folder_;
    std::string path_;
    Scene scene_;
};

TEST_F(WriteLightmapGlb, UnwrappedScenesReadBackWithTheUvsOfTheirLayout) {
    const auto layout = make_lightmap_layout(scene_, settings());
    ASSERT_TRUE(layout);
    const std::string written = folder_.path("uv1.glb");
    ASSERT_TRUE(write_unwrapped_glb(written, path_, *layout));
    const auto scene = read_gltf(written);
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->instances.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        const Mesh& before = scene_.meshes[scene_.instances[i].mesh];
        const Mesh& after = scene->meshes[scene->instances[i].mesh];
        const PackedCharts& charts = layout->packings[layout->places[i].packing].charts;
        ASSERT_EQ(after.indices.size(), before.indices.size());
        for (size_t corner = 0; corner < after.indices.size(); ++corner) {
            const uint32_t vertex = after.indices[corner];
            EXPECT_EQ(after.positions[vertex], before.positions[before.indices[corner]]);
            const glm::vec2 texels = after.uvs[1][vertex] * glm::vec2(charts.width, charts.height);
            EXPECT_NEAR(texels.x, charts.corner_uvs[corner].x, 1e-4f);
            EXPECT_NEAR(texels.y, charts.corner_uvs[corner].y, 1e-4f);
        }
    }
}

TEST_F(WriteLightmapGlb, WrittenUvsAreKeptWithoutWarnings) {
    const auto layout = make_lightmap_layout(scene_, settings());
    const std::string written = folder_.path("uv1.glb");
    ASSERT_TRUE(write_unwrapped_glb(written, path_, *layout));
    const auto scene = read_gltf(written);
    ASSERT_TRUE(scene);
    const auto kept = make_lightmap_layout(*scene, settings(LightmapUvs::Keep));
    ASSERT_TRUE(kept) << error_text(kept.error());
    EXPECT_EQ(kept->warnings, std::vector<std::string>{});
    EXPECT_EQ(kept->page_count, layout->page_count);
}

TEST_F(WriteLightmapGlb, LightmapsOfAnotherSceneNameTheObject) {
    const Lightmaps maps = bake();
    EXPECT_EQ(refusal(scene_, maps), "(no error)");
    Scene moved = scene_;
    moved.meshes[0].positions[3].x += 0.25f;
    EXPECT_EQ(refusal(moved, maps),
              "the lightmaps do not fit the object \"cube\" (instance 0): its positions or indices "
              "have changed since the lightmaps were baked");
    Scene shorter = scene_;
    shorter.meshes[0].indices.resize(33);
    EXPECT_NE(refusal(shorter, maps).find("it has 11 triangles, and had 12"), std::string::npos);
    shorter.instances.pop_back();
    EXPECT_EQ(refusal(shorter, maps), "the scene has 1 instances, the lightmaps have 2");
}

TEST_F(WriteLightmapGlb, PagesAreTexturesOfTheNodes) {
    const Lightmaps maps = bake();
    const std::string written = folder_.path("lit.glb");
    ASSERT_TRUE(write_lightmap_glb(written, path_, scene_, maps.view()));
    const auto bytes = read_file(written);
    uint32_t length = 0;
    std::memcpy(&length, bytes->data() + 12, sizeof length);
    const auto json = nlohmann::json::parse(
        std::string(reinterpret_cast<const char*>(bytes->data()) + 20, length));
    for (size_t i = 0; i < 2; ++i) {
        const auto& lightmap = json["nodes"][i]["extensions"]["MX_lightmap"];
        EXPECT_EQ(lightmap["lightMapTexture"]["index"], maps.rectangles[i].page);
        EXPECT_EQ(lightmap["offset"][0].get<float>(), maps.rectangles[i].offset.x);
        EXPECT_EQ(lightmap["scale"][1].get<float>(), maps.rectangles[i].scale.y);
    }
    EXPECT_EQ(json["images"].size(), maps.info.page_count);
    EXPECT_TRUE(read_gltf(written));
}

}  // namespace
}  // namespace tetralight
