// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/lightmap_nodes.h>

#include <glm/geometric.hpp>

#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// Members of a node that go where its mesh goes.
constexpr const char* kMeshMembers[] = {"skin", "weights"};

template <class Vector>
GltfJson numbers(const Vector& vector) {
    GltfJson array = GltfJson::array();
    for (int i = 0; i < Vector::length(); ++i) array.push_back(vector[i]);
    return array;
}

/// The transforms of EXT_mesh_gpu_instancing as members of nodes: `translation` and so on.
Result<std::vector<GltfJson>> instance_transforms(const GltfDocument& document,
                                                  const LightmapObject& object) {
    std::vector<GltfJson> transforms(object.transform_count, GltfJson::object());
    const auto& instancing = document.nodes[object.node].instancing;
    if (!instancing) return transforms;
    for (const auto& [name, accessor] : *instancing) {
        if (name == "TRANSLATION" || name == "SCALE") {
            const auto values = read_vec3s(document, accessor);
            if (!values) return values.error().in(name);
            const char* member = name == "SCALE" ? "scale" : "translation";
            for (size_t i = 0; i < transforms.size() && i < values->size(); ++i)
                transforms[i][member] = numbers((*values)[i]);
        } else if (name == "ROTATION") {
            const auto values = read_vec4s(document, accessor);
            if (!values) return values.error().in(name);
            for (size_t i = 0; i < transforms.size() && i < values->size(); ++i)
                transforms[i]["rotation"] = numbers(glm::normalize(glm::dvec4((*values)[i])));
        }
    }
    return transforms;
}

/// Animated weights of a node become those of its children.
void move_weight_channels(GltfJson& root, uint32_t node, const std::vector<uint32_t>& children) {
    const auto animations = root.find("animations");
    if (animations == root.end()) return;
    for (GltfJson& animation : *animations) {
        GltfJson channels = GltfJson::array();
        for (const GltfJson& channel : animation["channels"]) {
            const GltfJson target = channel.value("target", GltfJson::object());
            const bool is_moved =
                target.value("path", "") == "weights" && target.value("node", kNoIndex) == node;
            if (!is_moved) channels.push_back(channel);
            for (size_t i = 0; is_moved && i < children.size(); ++i) {
                channels.push_back(channel);
                channels.back()["target"]["node"] = children[i];
            }
        }
        animation["channels"] = std::move(channels);
    }
}

}  // namespace

Status LightmapNodes::write(const LightmapObject& object) {
    const GltfNode& node = document_.nodes[object.node];
    if (node.instancing || document_.meshes[node.mesh].primitives.size() > 1) {
        const auto status = write_children(object);
        if (!status) return in_element(status.error(), "nodes", object.node, node.name);
        return Ok{};
    }
    const GltfPrimitivePlace primitive{node.mesh, 0};
    const uint32_t mesh = meshes_.mesh_of(primitive, object.places[0].uvs);
    GltfJson& target = parts_.json["nodes"][object.node];
    target["mesh"] = mesh;
    const auto status = write_place(target, primitive, object.places[0]);
    if (!status) return in_element(status.error(), "nodes", object.node, node.name);
    return Ok{};
}

Status LightmapNodes::write_place(GltfJson& node, GltfPrimitivePlace primitive,
                                  const GltfLightmapPlace& place) const {
    if (place.uvs == kNoIndex) return Ok{};
    const GltfJson scale = numbers(place.scale), offset = numbers(place.offset);
    const uint32_t set = meshes_.uv_set(primitive);
    if (pages_.first_texture != kNoIndex) {
        const GltfJson texture = {{"index", pages_.first_texture + place.page}, {"texCoord", set}};
        node["extensions"]["MX_lightmap"] = {{"lightMapTexture", texture},
                                             {"scale", scale},
                                             {"offset", offset},
                                             {"intensity", pages_.intensity}};
        return Ok{};
    }
    if (node.contains("extras") && !node["extras"].is_object()) {
        return Error{ErrorCode::Unsupported, ".extras", "",
                     "extras is not an object, so that the place of the lightmap has no room"};
    }
    node["extras"]["lightmap_rectangle"] = {
        {"page", place.page}, {"scale", scale}, {"offset", offset}, {"texCoord", set}};
    return Ok{};
}

Status LightmapNodes::write_children(const LightmapObject& object) {
    const GltfNode& source = document_.nodes[object.node];
    const auto transforms = instance_transforms(document_, object);
    if (!transforms) return transforms.error();
    const GltfJson parent = parts_.json["nodes"][object.node];
    const size_t primitives = document_.meshes[source.mesh].primitives.size();
    std::vector<uint32_t> children;
    for (size_t i = 0; i < object.places.size(); ++i) {
        const GltfPrimitivePlace primitive{source.mesh, static_cast<uint32_t>(i % primitives)};
        GltfJson child = (*transforms)[i / primitives];
        std::string name = source.name;
        if (transforms->size() > 1) name += str_cat(" instance ", i / primitives);
        if (primitives > 1) name += str_cat(" primitive ", i % primitives);
        child["name"] = name;
        child["mesh"] = meshes_.mesh_of(primitive, object.places[i].uvs);
        for (const char* member : kMeshMembers) {
            if (parent.contains(member)) child[member] = parent[member];
        }
        if (auto status = write_place(child, primitive, object.places[i]); !status) return status;
        children.push_back(parts_.add("nodes", std::move(child)));
    }
    GltfJson& node = parts_.json["nodes"][object.node];
    node.erase("mesh");
    for (const char* member : kMeshMembers) node.erase(member);
    if (node.contains("extensions")) {
        node["extensions"].erase(kInstancing);
        if (node["extensions"].empty()) node.erase("extensions");
    }
    GltfJson all = children;
    for (const GltfJson& child : parent.value("children", GltfJson::array())) all.push_back(child);
    node["children"] = std::move(all);
    move_weight_channels(parts_.json, object.node, children);
    return Ok{};
}

}  // namespace tetralight::detail
