// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/bake/scene/glb_container.h>
#include <tetralight/bake/scene/probe_groups_gltf.h>
#include <tetralight/base/file.h>

namespace tetralight {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// glTF 2.0, sections 3.6.2, 3.7.2 and 4.4.
constexpr uint32_t kFloat = 5126;
constexpr uint32_t kArrayBuffer = 34962;
constexpr uint32_t kPoints = 0;

Json array(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json array(const glm::dmat4& m) {
    Json numbers = Json::array();
    for (int i = 0; i < 16; ++i) numbers.push_back(m[i / 4][i % 4]);
    return numbers;
}

/// A glTF document and its binary chunk, to which groups are added.
class Document {
  public:
    Document() {
        json_ = {{"asset", {{"version", "2.0"}, {"generator", "Tetralight"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", Json::array()}}})},
                 {"nodes", Json::array()}};
    }

    void add(const ProbeGroup& group) {
        const glm::dvec3 first =
            group.positions.empty() ? glm::dvec3(0.0) : group.positions.front();
        Json node = {{"name", group.name},
                     {"matrix", array(glm::translate(group.world_from_group, first))},
                     {"extras", {{"light_probe_group", true}}}};
        if (group.dering) node["extras"]["dering"] = true;
        if (group.rendering_layers != kAllRenderingLayers) {
            node["extras"]["rendering_layers"] =
                detail::rendering_layer_list(group.rendering_layers);
        }
        if (!group.positions.empty()) node["mesh"] = add_points(group, first);
        json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
        json_["nodes"].push_back(node);
    }

    [[nodiscard]] Result<std::vector<std::byte>> bytes() {
        if (!binary_.empty()) {
            json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        }
        return make_glb(json_.dump(), binary_);
    }

  private:
    /// Returns the index of a new mesh with the group's points, relative to the first of them.
    size_t add_points(const ProbeGroup& group, const glm::dvec3& first) {
        std::vector<glm::vec3> points;
        glm::vec3 min(0.0f), max(0.0f);
        for (const glm::dvec3& position : group.positions) {
            points.emplace_back(position - first);
            min = glm::min(min, points.back());
            max = glm::max(max, points.back());
        }
        const std::span bytes = std::as_bytes(std::span(points));
        const size_t index = json_["meshes"].size();
        json_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", binary_.size()},
                                        {"byteLength", bytes.size()},
                                        {"target", kArrayBuffer}});
        json_["accessors"].push_back({{"bufferView", index},
                                      {"componentType", kFloat},
                                      {"count", points.size()},
                                      {"type", "VEC3"},
                                      {"min", array(min)},
                                      {"max", array(max)}});
        const Json primitive = {{"attributes", {{"POSITION", index}}}, {"mode", kPoints}};
        json_["meshes"].push_back({{"name", group.name}, {"primitives", Json::array({primitive})}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return index;
    }

    Json json_;
    std::vector<std::byte> binary_;
};

}  // namespace

Status write_probe_groups_glb(const std::string& path, std::span<const ProbeGroup> groups) {
    const auto status = detail::check_writable_groups(groups);
    if (!status) return status.error().in(path);
    Document document;
    for (const ProbeGroup& group : groups) document.add(group);
    const auto bytes = document.bytes();
    if (!bytes) return bytes.error().in(path);
    return write_file(path, *bytes);
}

}  // namespace tetralight
