// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lppv_object.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

bool asks_for_volume(const Scene& scene, uint32_t node) {
    return node != kNoIndex && scene.nodes[node].light_probes == LightProbeUsage::ProxyVolume;
}

void add_instance(const Scene& scene, uint32_t index, SceneObject& object) {
    const MeshInstance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.positions.empty()) return;
    LppvPart part{instance.world_from_mesh, glm::dvec3(mesh.positions[0]),
                  glm::dvec3(mesh.positions[0])};
    for (const glm::vec3& position : mesh.positions) {
        part.min = glm::min(part.min, glm::dvec3(position));
        part.max = glm::max(part.max, glm::dvec3(position));
    }
    object.parts.push_back(part);
    object.instances.push_back(index);
}

/// True if the node is `top`, or a descendant of it and all nodes from it up to `top` ask for a
/// volume.
bool shares_volume(const Scene& scene, uint32_t node, uint32_t top) {
    while (node != top) {
        if (!asks_for_volume(scene, node)) return false;
        node = scene.nodes[node].parent;
    }
    return true;
}

SceneObject object_at(const Scene& scene, uint32_t top) {
    SceneObject object;
    object.place = "node \"" + scene.nodes[top].name + "\"";
    object.world_from_object = scene.nodes[top].world_from_node;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (shares_volume(scene, scene.instances[i].node, top)) add_instance(scene, i, object);
    }
    return object;
}

}  // namespace

Result<LppvGrid> make_object_grid(const SceneObject& object, const LppvSettings& settings) {
    auto grid = make_lppv_grid(object.view(), settings);
    if (!grid) return grid.error().in(object.place);
    return grid;
}

Result<SceneObject> find_object(const Scene& scene, const std::string& name) {
    uint32_t found = kNoIndex;
    for (uint32_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].name != name) continue;
        if (found != kNoIndex) {
            return Error{ErrorCode::InvalidArgument, "object", name,
                         "there are several nodes \"" + name + "\""};
        }
        found = node;
    }
    if (found == kNoIndex) {
        return Error{ErrorCode::NotFound, "object", name, "there is no node \"" + name + "\""};
    }
    return object_at(scene, found);
}

std::vector<SceneObject> find_proxy_objects(const Scene& scene) {
    std::vector<SceneObject> objects;
    for (uint32_t node = 0; node < scene.nodes.size(); ++node) {
        if (!asks_for_volume(scene, node)) continue;
        if (asks_for_volume(scene, scene.nodes[node].parent)) continue;
        SceneObject object = object_at(scene, node);
        const auto moves = [&](uint32_t i) { return !scene.instances[i].contributes_gi; };
        if (std::ranges::any_of(object.instances, moves)) objects.push_back(std::move(object));
    }
    return objects;
}

}  // namespace tetralight
