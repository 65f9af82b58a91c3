// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/lightmap_meshes.h>

#include <algorithm>

#include <tetralight/bake/scene/detail/gltf_instances.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// The mesh of `GltfMeshes::meshes` of each primitive that has triangles.
std::map<GltfPrimitivePlace, uint32_t> scene_meshes(const GltfMeshes& meshes) {
    std::map<GltfPrimitivePlace, uint32_t> result;
    for (uint32_t mesh = 0; mesh < meshes.meshes_of.size(); ++mesh) {
        for (const uint32_t scene_mesh : meshes.meshes_of[mesh])
            result[{mesh, meshes.primitive_of[scene_mesh]}] = scene_mesh;
    }
    return result;
}

Error count_error(size_t instances, size_t places) {
    return {ErrorCode::InvalidArgument, "instances", str_cat(places),
            str_cat("has ", instances, " instances, the lightmaps have ", places)};
}

Error posed_error(const GltfDocument& document, uint32_t node) {
    return {ErrorCode::InvalidArgument, "instances", "",
            str_cat(gltf_place("node", node, document.nodes[node].name),
                    " is deformed by morph targets or a skin, so that it has no lightmap")};
}

Error triangle_error(const GltfDocument& document, uint32_t node, const Mesh& mesh,
                     size_t corner_count) {
    return {
        ErrorCode::InvalidArgument, "instances", "",
        str_cat(gltf_place("node", node, document.nodes[node].name), " has ",
                mesh.indices.size() / 3, " triangles, its lightmap UVs have ", corner_count / 3)};
}

Error primitive_error(const GltfDocument& document, GltfPrimitivePlace place, const Error& error) {
    return in_element(error.in(str_cat("primitive ", place.second)), "meshes", place.first,
                      document.meshes[place.first].name);
}

using Uses = std::map<std::pair<GltfPrimitivePlace, uint32_t>, uint32_t>;

/// Primitives with their UVs, each with the first node that has them.
Uses uses_of(const GltfDocument& document, std::span<const LightmapObject> objects,
             std::map<GltfPrimitivePlace, uint32_t>& first) {
    Uses uses;
    for (const LightmapObject& object : objects) {
        const uint32_t mesh = document.nodes[object.node].mesh;
        const size_t primitives = document.meshes[mesh].primitives.size();
        for (size_t i = 0; i < object.places.size(); ++i) {
            if (object.places[i].uvs == kNoIndex) continue;
            const GltfPrimitivePlace place{mesh, static_cast<uint32_t>(i % primitives)};
            uses.try_emplace({place, object.places[i].uvs}, object.node);
            first.try_emplace(place, object.places[i].uvs);
        }
    }
    return uses;
}

}  // namespace

Result<std::vector<LightmapObject>> lightmap_objects(const GltfDocument& document,
                                                     std::span<const GltfWorldNode> nodes,
                                                     const std::vector<bool>& is_probe,
                                                     const GltfMeshes& meshes,
                                                     std::span<const GltfLightmapPlace> places) {
    std::vector<LightmapObject> objects;
    size_t instance = 0;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (node.mesh == kNoIndex || is_probe[placed.node] || !placed.is_visible) continue;
        const bool is_posed = meshes.posed_meshes_of.contains(placed.node);
        const bool is_in_world = is_posed && is_skinned(document, node);
        LightmapObject object{placed.node, is_in_world ? 1 : transform_count(document, node), {}};
        const size_t primitives = document.meshes[node.mesh].primitives.size();
        const auto& scene_meshes = meshes.meshes_of_node(document, placed.node);
        const auto placements =
            is_in_world ? std::vector<GltfPlacement>{{}} : mesh_placements(document, placed);
        if (!placements) return in_element(placements.error(), "nodes", placed.node, node.name);
        const size_t count = placements->size() * scene_meshes.size();
        if (instance + count > places.size()) return count_error(instance + count, places.size());
        object.places.resize(object.transform_count * primitives);
        for (size_t i = 0; i < count; ++i, ++instance) {
            const size_t transform = (*placements)[i / scene_meshes.size()].transform;
            const uint32_t primitive = meshes.primitive_of[scene_meshes[i % scene_meshes.size()]];
            object.places[transform * primitives + primitive] = places[instance];
        }
        const bool has_lightmap = std::ranges::any_of(
            object.places, [](const GltfLightmapPlace& place) { return place.uvs != kNoIndex; });
        if (has_lightmap && is_posed) return posed_error(document, placed.node);
        if (has_lightmap) objects.push_back(std::move(object));
    }
    if (instance != places.size()) return count_error(instance, places.size());
    return objects;
}

Result<LightmapMeshes> LightmapMeshes::write(const GltfDocument& document, const GltfMeshes& meshes,
                                             std::span<const LightmapObject> objects,
                                             std::span<const std::span<const glm::vec2>> corner_uvs,
                                             GltfParts& parts) {
    LightmapMeshes result(parts);
    std::map<GltfPrimitivePlace, uint32_t> first;
    const Uses uses = uses_of(document, objects, first);
    std::set<GltfPrimitivePlace> replaced;
    for (const auto& [place, uvs] : first) {
        replaced.insert(place);
        result.first_[place].uvs = uvs;
    }
    const GltfJson sources = parts.json.value("meshes", GltfJson::array());
    parts.release_primitives(replaced);
    const auto scene_mesh = scene_meshes(meshes);
    for (const auto& [use, node] : uses) {
        const auto& [place, uvs] = use;
        const Mesh& mesh = meshes.meshes[scene_mesh.at(place)];
        if (corner_uvs[uvs].size() != mesh.indices.size())
            return triangle_error(document, node, mesh, corner_uvs[uvs].size());
        const GltfJson& source = sources[place.first]["primitives"][place.second];
        const GltfPrimitive& elements = document.meshes[place.first].primitives[place.second];
        auto primitive =
            make_lightmap_primitive(document, parts, {source, elements}, mesh, corner_uvs[uvs]);
        if (!primitive) return primitive_error(document, place, primitive.error());
        result.add(place, uvs, std::move(*primitive));
    }
    return result;
}

void LightmapMeshes::add(GltfPrimitivePlace place, uint32_t uvs, LightmapPrimitive primitive) {
    First& first = first_[place];
    first.uv_set = primitive.uv_set;
    if (first.uvs == uvs) {
        GltfJson& primitives = parts_->json["meshes"][place.first]["primitives"];
        primitives[place.second] = primitive.json;
        if (primitives.size() == 1) meshes_[{place, uvs}] = place.first;
    }
    primitives_[{place, uvs}] = std::move(primitive.json);
}

std::string LightmapMeshes::mesh_name(GltfPrimitivePlace place, uint32_t uvs) const {
    const GltfJson& mesh = parts_->json["meshes"][place.first];
    std::string name = mesh.value("name", str_cat("mesh ", place.first));
    if (mesh["primitives"].size() > 1) name += str_cat(" primitive ", place.second);
    const auto copies = copy_count_.find(place);
    if (uvs == kNoIndex || copies == copy_count_.end()) return name;
    return name + str_cat(" lightmap ", copies->second + 1);
}

uint32_t LightmapMeshes::mesh_of(GltfPrimitivePlace place, uint32_t uvs) {
    const auto known = meshes_.find({place, uvs});
    if (known != meshes_.end()) return known->second;
    const bool is_single = parts_->json["meshes"][place.first]["primitives"].size() == 1;
    if (is_single && uvs == kNoIndex) return place.first;
    if (is_single) copy_count_.try_emplace(place, 1);  // the mesh itself has the first UVs
    GltfJson mesh = parts_->json["meshes"][place.first];
    mesh["name"] = mesh_name(place, uvs);
    if (uvs != kNoIndex) ++copy_count_[place];
    const auto primitive = primitives_.find({place, uvs});
    const GltfJson json =
        primitive == primitives_.end() ? mesh["primitives"][place.second] : primitive->second;
    mesh["primitives"] = GltfJson::array({json});
    const uint32_t index = parts_->add("meshes", std::move(mesh));
    meshes_[{place, uvs}] = index;
    return index;
}

}  // namespace tetralight::detail
