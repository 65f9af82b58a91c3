// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 (.glb) with the extension TETRALIGHT_probe_volume (docs/gltf_probe_volume.md): cells and
// light as queries read them, and the probes as points, a node for each group.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>

#include <tetralight/bake/scene/glb_container.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight::detail {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "TETRALIGHT_probe_volume";

enum ComponentType : int { kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126 };

/// What a buffer view is for, if a graphics API reads it.
enum Target : int { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };

/// An accessor over as many elements as fit the data.
struct AccessorType {
    const char* name;
    ComponentType component;
    size_t element_size;
    Target target = kNoTarget;
};

constexpr AccessorType kFloats{"SCALAR", kFloat, 4}, kVectors{"VEC3", kFloat, 12},
    kVectors4{"VEC4", kFloat, 16}, kPoints{"VEC3", kFloat, 12, kVertices},
    kNumbers{"SCALAR", kInt, 4}, kPointIndices{"SCALAR", kInt, 4, kIndices},
    kNumbers4{"VEC4", kInt, 16}, kShorts{"SCALAR", kShort, 2}, kBytes4{"VEC4", kByte, 4};

/// A glTF file of one buffer.
class GlbWriter {
  public:
    Json json{{"asset", {{"version", "2.0"}, {"generator", "tetralight"}}}};

    /// The index of a new accessor. Precondition: values are not empty.
    template <class Value>
    int add(const AccessorType& type, std::span<const Value> values) {
        Json view{{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", values.size_bytes()}};
        if (type.target != kNoTarget) view["target"] = static_cast<int>(type.target);
        json["bufferViews"].push_back(view);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", static_cast<int>(type.component)},
                                     {"count", values.size_bytes() / type.element_size},
                                     {"type", type.name}});
        data_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        data_.resize((data_.size() + 3) / 4 * 4);
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    /// The same as a member of `object`; nothing if `values` is empty.
    template <class Value>
    void add_to(Json& object, const char* name, const AccessorType& type,
                std::span<const Value> values) {
        if (!values.empty()) object[name] = add(type, values);
    }

    /// Returns the errors of `make_glb`.
    [[nodiscard]] Result<std::string> file() {
        if (!data_.empty()) json["buffers"].push_back({{"byteLength", data_.size()}});
        const auto bytes = make_glb(json.dump(-1, ' ', false, Json::error_handler_t::replace),
                                    std::as_bytes(std::span(data_)));
        if (!bytes) return bytes.error();
        return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    }

  private:
    std::string data_;
};

Json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// The mean of each channel over all normals, brought into [0, 1): x / (x + the mean of all).
std::vector<glm::vec3> shown_colors(const std::vector<IrradianceSh>& light) {
    const float y0 = 0.5f * std::sqrt(std::numbers::inv_pi_v<float>);
    std::vector<glm::vec3> colors;
    double sum = 0.0;
    for (const IrradianceSh& probe : light) {
        const glm::vec3 mean = y0 * probe.coefficients[0];
        colors.push_back({std::max(mean.r, 0.0f), std::max(mean.g, 0.0f), std::max(mean.b, 0.0f)});
        sum += double{colors.back().r} + colors.back().g + colors.back().b;
    }
    const auto middle = static_cast<float>(sum / (3.0 * static_cast<double>(colors.size())));
    for (glm::vec3& color : colors) {
        for (int c = 0; c < 3; ++c) color[c] = middle > 0.0f ? color[c] / (color[c] + middle) : 0;
    }
    return colors;
}

const char* shape_name(Dimension dimension) {
    constexpr std::array kShapes{"none", "points", "segments", "triangles", "tetrahedra"};
    return kShapes[static_cast<size_t>(dimension)];
}

/// What walls hide: the cells that have an element of `cell_visibility`, and these elements.
Json walls_json(const ProbeVolumeView& volume, GlbWriter& file) {
    std::vector<uint32_t> cells;
    std::vector<std::array<uint8_t, 12>> codes;
    std::vector<uint16_t> splits;
    for (uint32_t cell = 0; cell < volume.cells.size(); ++cell) {
        const uint32_t element = find_visibility(volume, cell);
        if (element == kNoIndex) continue;
        cells.push_back(cell);
        codes.push_back(volume.cell_visibility[element].codes);
        splits.push_back(static_cast<uint16_t>(split_bits(volume.cell_visibility[element])));
    }
    if (cells.empty()) return {};
    return {{"cells", file.add(kNumbers, std::span<const uint32_t>(cells))},
            {"codes", file.add(kBytes4, std::span<const std::array<uint8_t, 12>>(codes))},
            {"splits", file.add(kShorts, std::span<const uint16_t>(splits))}};
}

void add_volume_cells(const ProbeVolumeView& volume, GlbWriter& file, Json& json) {
    std::vector<std::array<uint32_t, 4>> vertices;
    std::vector<std::array<uint32_t, 4>> neighbors;
    for (const Cell& cell : volume.cells) {
        vertices.push_back(cell.vertices);
        neighbors.push_back(cell.neighbors);
    }
    using Indices = std::span<const std::array<uint32_t, 4>>;
    file.add_to(json, "cellVertices", kNumbers4, Indices(vertices));
    file.add_to(json, "cellNeighbors", kNumbers4, Indices(neighbors));
    file.add_to(json, "hullRays", kVectors, volume.hull_rays);
    if (Json walls = walls_json(volume, file); !walls.is_null()) json["walls"] = walls;
}

/// The volume in the extension. `positions` is an accessor.
Json volume_json(const ProbeVolumeView& volume, const std::vector<IrradianceSh>& light,
                 std::optional<int> positions, GlbWriter& file) {
    Json json{{"version", 1},
              {"shape", shape_name(volume.info.dimension)},
              {"origin", vector_json(volume.info.world_origin)},
              {"extent", volume.info.extent},
              {"innerCellCount", volume.info.inner_cell_count}};
    if (volume.info.axis != glm::dvec3(0.0)) json["axis"] = vector_json(volume.info.axis);
    for (const glm::vec3& c : volume.info.ambient.coefficients) {
        for (int channel = 0; channel < 3; ++channel) json["ambient"].push_back(c[channel]);
    }
    if (positions) json["positions"] = *positions;
    const bool is_baked = !volume.irradiance.empty() || !volume.compact.empty();
    if (is_baked) file.add_to(json, "irradiance", kVectors, std::span(light));
    const std::vector<glm::vec4> occlusion = probe_occlusion(volume);
    file.add_to(json, "occlusion", kVectors4, std::span(occlusion));
    file.add_to(json, "validity", kFloats, volume.validity);
    file.add_to(json, "renderingLayers", kNumbers, volume.rendering_layers);
    add_volume_cells(volume, file, json);
    return json;
}

/// A node with the probes of one group as points.
void add_group_points(const std::string& name, const Json& attributes,
                      const std::vector<uint32_t>& probes, GlbWriter& file) {
    if (probes.empty()) return;
    const Json primitive{{"attributes", attributes},
                         {"indices", file.add(kPointIndices, std::span<const uint32_t>(probes))},
                         {"material", 0},
                         {"mode", 0}};
    file.json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    Json node{{"mesh", file.json["meshes"].size() - 1}};
    if (!name.empty()) node["name"] = name;
    file.json["nodes"][0]["children"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back(node);
}

/// The accessor of the positions.
int add_all_points(const ProbeVolumeView& volume, const std::vector<IrradianceSh>& light,
                   GlbWriter& file) {
    const int positions = file.add(kPoints, volume.positions);
    auto box = Box<glm::vec3>::empty();
    for (const glm::vec3& position : volume.positions) box = union_of(box, position);
    file.json["accessors"][0]["min"] = {box.min.x, box.min.y, box.min.z};
    file.json["accessors"][0]["max"] = {box.max.x, box.max.y, box.max.z};
    const std::vector<glm::vec3> colors = shown_colors(light);
    const Json attributes{{"POSITION", positions},
                          {"COLOR_0", file.add(kPoints, std::span<const glm::vec3>(colors))}};
    file.json["materials"].push_back(
        {{"name", "probes"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    const auto names = split_names(volume.group_names);
    std::vector<std::vector<uint32_t>> groups(names.size() + 1);  // the last: of no group
    const auto group_of = probe_groups(volume);
    for (uint32_t probe = 0; probe < group_of.size(); ++probe) {
        groups[std::min<size_t>(group_of[probe], names.size())].push_back(probe);
    }
    for (size_t i = 0; i < groups.size(); ++i) {
        add_group_points(i < names.size() ? std::string(names[i]) : "", attributes, groups[i],
                         file);
    }
    return positions;
}

}  // namespace

Result<ExportedVolume> export_gltf(const ProbeVolumeView& volume, const ExportSettings& settings) {
    GlbWriter file;
    file.json["extensionsUsed"] = {kExtension};
    file.json["scene"] = 0;
    file.json["scenes"] = Json::array({{{"nodes", {0}}}});
    file.json["nodes"] = Json::array({{{"name", settings.name},
                                       {"translation", vector_json(volume.info.world_origin)},
                                       {"extensions", {{kExtension, {{"volume", 0}}}}}}});
    const auto light = probe_light(volume);
    std::optional<int> positions;
    if (!volume.positions.empty()) {
        file.json["extensionsUsed"].push_back("KHR_materials_unlit");
        positions = add_all_points(volume, light, file);
    }
    file.json["extensions"][kExtension]["volumes"] =
        Json::array({volume_json(volume, light, positions, file)});
    auto bytes = file.file();
    if (!bytes) return bytes.error();
    return ExportedVolume{{{settings.name + ".glb", *std::move(bytes)}}, {}, {}};
}

}  // namespace tetralight::detail
