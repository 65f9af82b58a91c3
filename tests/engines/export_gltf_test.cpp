// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <tetralight/engines/export_target.h>
#include <tetralight/engines/sampled_grid.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

std::string glb_of(const ProbeVolumeView& volume, const std::string& name = "v") {
    const auto exported = find_export_target("gltf")->make(volume, {.name = name});
    EXPECT_TRUE(exported);
    return exported->files[0].content;
}

uint32_t word(const std::string& bytes, size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// Reads a volume from the extension as docs/gltf_probe_volume.md describes it.
class GltfVolume {
  public:
    explicit GltfVolume(const std::string& glb) {
        EXPECT_EQ(glb.substr(0, 4), "glTF");
        EXPECT_EQ(word(glb, 4), 2u);
        EXPECT_EQ(word(glb, 8), glb.size());
        const size_t text_size = word(glb, 12);
        gltf_ = Json::parse(glb.substr(20, text_size));
        if (glb.size() > 20 + text_size) data_ = glb.substr(28 + text_size);
        read(gltf_["extensions"]["TETRALIGHT_probe_volume"]["volumes"][0]);
    }

    [[nodiscard]] ProbeVolumeView view() const { return volume_.view(); }

    [[nodiscard]] const Json& gltf() const { return gltf_; }

    template <class Value>
    [[nodiscard]] std::vector<Value> values(const Json& accessor_index) const {
        const Json& accessor = gltf_["accessors"][accessor_index.get<size_t>()];
        const Json& view = gltf_["bufferViews"][accessor["bufferView"].get<size_t>()];
        const auto size = view["byteLength"].get<size_t>();
        EXPECT_EQ(size, accessor["count"].get<size_t>() * element_size(accessor));
        EXPECT_EQ(size % sizeof(Value), 0u);
        std::vector<Value> values(size / sizeof(Value));
        std::memcpy(values.data(), data_.data() + view["byteOffset"].get<size_t>(), size);
        return values;
    }

  private:
    static size_t element_size(const Json& accessor) {
        const std::string type = accessor["type"];
        const size_t components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
        const int component = accessor["componentType"];
        return components * (component == 5121 ? 1 : component == 5123 ? 2 : 4);
    }

    template <class Value>
    [[nodiscard]] std::vector<Value> values(const Json& json, const char* name) const {
        return json.contains(name) ? values<Value>(json[name]) : std::vector<Value>();
    }

    void read(const Json& json) {
        constexpr std::array kShapes{"none", "points", "segments", "triangles", "tetrahedra"};
        const auto shape = std::ranges::find(kShapes, json["shape"].get<std::string>());
        volume_.info.dimension = static_cast<Dimension>(shape - kShapes.begin());
        volume_.info.inner_cell_count = json["innerCellCount"];
        volume_.info.extent = json["extent"];
        for (int axis = 0; axis < 3; ++axis) {
            volume_.info.world_origin[axis] = json["origin"][axis];
            if (json.contains("axis")) volume_.info.axis[axis] = json["axis"][axis];
        }
        for (int i = 0; i < 27; ++i) {
            volume_.info.ambient.coefficients[i / 3][i % 3] = json["ambient"][i];
        }
        volume_.positions = values<glm::vec3>(json, "positions");
        volume_.irradiance = values<IrradianceSh>(json, "irradiance");
        volume_.occlusion = values<glm::vec4>(json, "occlusion");
        volume_.validity = values<float>(json, "validity");
        volume_.rendering_layers = values<uint32_t>(json, "renderingLayers");
        volume_.hull_rays = values<HullCellRays>(json, "hullRays");
        const auto vertices = values<std::array<uint32_t, 4>>(json, "cellVertices");
        const auto neighbors = values<std::array<uint32_t, 4>>(json, "cellNeighbors");
        for (size_t i = 0; i < vertices.size(); ++i) {
            volume_.cells.push_back({vertices[i], neighbors[i]});
        }
        if (json.contains("walls")) read_walls(json["walls"]);
    }

    void read_walls(const Json& walls) {
        const auto cells = values<uint32_t>(walls["cells"]);
        const auto codes = values<std::array<uint8_t, 12>>(walls["codes"]);
        const auto splits = values<std::array<uint8_t, 2>>(walls["splits"]);
        volume_.visibility_blocks.resize((volume_.cells.size() + 31) / 32);
        for (size_t i = 0; i < cells.size(); ++i) {
            VisibilityBlock& block = volume_.visibility_blocks[cells[i] / 32];
            if (block.cells == 0) block.first = static_cast<uint32_t>(i);
            block.cells |= uint32_t{1} << cells[i] % 32;
            volume_.cell_visibility.push_back({codes[i], splits[i]});
        }
    }

    Json gltf_;
    std::string data_;
    ProbeVolume volume_;
};

/// Without what the extension leaves out: where walks begin. Light in full precision, if it is
/// there.
ProbeVolumeView comparable(ProbeVolumeView volume) {
    volume.seeds = {};
    volume.seed_grid = {};
    return volume.irradiance.empty() ? volume : volume.without_compact();
}

/// Positions in the box of the probes and around it, and far away.
std::vector<glm::vec3> positions_around(const ProbeVolumeView& volume) {
    const Box<glm::dvec3> box = world_bounds(volume);
    const double scale = 1.0 + box.size().x + box.size().y + box.size().z;
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : test::random_positions(300, 4, scale)) {
        positions.emplace_back((box.min + box.max) * 0.5 + p * (positions.size() < 200 ? 0.3 : 9));
    }
    return positions;
}

/// Volumes of every dimension, with walls, occlusion and rendering layers, without light, far from
/// the origin.
TEST(ExportGltf, AnswersAsTheVolume) {
    size_t walls = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TETRALIGHT_VECTORS)) {
        if (entry.path().extension() != ".probes") continue;
        SCOPED_TRACE(entry.path());
        const auto file = open_probe_file(entry.path());
        ASSERT_TRUE(file);
        const ProbeVolumeView volume = comparable(file->view());
        const GltfVolume read(glb_of(volume));
        walls += read.view().cell_visibility.size();
        for (const glm::vec3& position : positions_around(volume)) {
            const CellLocation location = locate(volume, position);
            EXPECT_EQ(locate(read.view(), position).cell, location.cell);
            for (const uint32_t layers : {kAllRenderingLayers, 1u}) {
                const Receiver receiver{.rendering_layers = layers};
                EXPECT_EQ(interpolate(read.view(), locate(read.view(), position), receiver),
                          interpolate(volume, location, receiver));
            }
        }
    }
    EXPECT_GT(walls, 0u);
}

/// Any viewer shows the probes: points at their positions, a node for each group.
TEST(ExportGltf, ShowsGroupsAsNodesOfPoints) {
    std::vector<ProbeGroup> groups(2);
    groups[0].name = "a";
    groups[1].name = "b";
    for (const glm::dvec3& p : test::random_positions(20, 1)) {
        groups[p.x > 0 ? 1 : 0].positions.push_back(p + glm::dvec3(1e6, 0, 0));
    }
    ProbeVolume volume = make_probe_volume(*merge(groups));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.irradiance.push_back(test::linear_light(p - glm::dvec3(1e6, 0, 0)));
    }
    volume.group_names = "a \"b\" \\ \x01\nnot UTF-8: \xFF\n";
    const GltfVolume read(glb_of(volume.view(), "v\n"));
    const Json& gltf = read.gltf();
    ASSERT_EQ(gltf["nodes"].size(), 3u);
    EXPECT_EQ(gltf["nodes"][0]["name"], "v\n");
    EXPECT_EQ(gltf["nodes"][0]["translation"][0], volume.info.world_origin.x);
    EXPECT_EQ(gltf["nodes"][1]["name"], "a \"b\" \\ \x01");
    EXPECT_EQ(gltf["nodes"][2]["name"], "not UTF-8: \xEF\xBF\xBD");
    EXPECT_FALSE(gltf.contains("extensionsRequired"));
    size_t count = 0;
    for (const int node : {1, 2}) {
        const Json& primitive =
            gltf["meshes"][gltf["nodes"][node]["mesh"].get<size_t>()]["primitives"][0];
        EXPECT_EQ(primitive["mode"], 0);
        const auto points = read.values<glm::vec3>(primitive["attributes"]["POSITION"]);
        for (const uint32_t probe : read.values<uint32_t>(primitive["indices"])) {
            EXPECT_EQ(points[probe], volume.positions[probe]);
            EXPECT_EQ(volume.info.world_origin.x + points[probe].x > 1e6, node == 2);
            ++count;
        }
        for (const glm::vec3& color : read.values<glm::vec3>(primitive["attributes"]["COLOR_0"])) {
            EXPECT_TRUE(contains(Box<glm::vec3>{glm::vec3(0.0f), glm::vec3(1.0f)}, color));
        }
    }
    EXPECT_EQ(count, 20u);
}

/// By Ajv, which `./run test` installs with a validator of OpenAPI.
TEST(ExportGltf, FitsItsSchemas) {
    if (!std::filesystem::exists(TETRALIGHT_NODE_MODULES "/ajv/package.json")) {
        GTEST_SKIP() << "npm has not installed openapi-schema-validator";
    }
    const TempFolder folder;
    std::string command =
        "node " TETRALIGHT_SOURCE_DIR "/tests/engines/validate_gltf.mjs " TETRALIGHT_NODE_MODULES
        " " TETRALIGHT_SOURCE_DIR "/docs/schemas";
    for (const auto& entry : std::filesystem::directory_iterator(TETRALIGHT_VECTORS)) {
        if (entry.path().extension() != ".probes") continue;
        const std::string name = entry.path().stem().string() + ".glb";
        command += " " + folder.write(name, glb_of(open_probe_file(entry.path())->view()));
    }
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace tetralight
