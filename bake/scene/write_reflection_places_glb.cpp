// SPDX-License-Identifier: Apache-2.0
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/glb_container.h>
#include <tetralight/bake/scene/reflection_places_gltf.h>
#include <tetralight/base/file.h>

namespace tetralight {
namespace {

template <class Vec>
nlohmann::ordered_json three_numbers(const Vec& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

nlohmann::ordered_json node_of(const ReflectionPlace& place) {
    glm::dmat3 axes(place.axes);
    if (glm::determinant(axes) < 0.0) axes[2] = -axes[2];  // the same box
    nlohmann::ordered_json node = {{"name", place.name},
                                   {"translation", three_numbers(place.position)}};
    if (axes != glm::dmat3(1.0)) {
        const glm::dquat q = glm::normalize(glm::quat_cast(axes));
        node["rotation"] = {q.x, q.y, q.z, q.w};
    }
    const glm::dvec3 center = glm::transpose(axes) * glm::dvec3(place.box_center);
    node["extras"]["reflection_probe"] = {
        {"size", three_numbers(2.0 * glm::dvec3(place.half_size))},
        {"center", three_numbers(center)},
        {"blend_distance", place.blend_distance},
        {"importance", place.importance},
        {"near", place.near_distance}};
    return node;
}

}  // namespace

Status write_reflection_places_glb(const std::string& path,
                                   std::span<const ReflectionPlace> places) {
    using Json = nlohmann::ordered_json;
    if (auto status = check_reflection_places(places); !status) return status.error().in(path);
    Json roots = Json::array(), nodes = Json::array();
    for (const ReflectionPlace& place : places) {
        roots.push_back(nodes.size());
        nodes.push_back(node_of(place));
    }
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "Tetralight"}}}, {"scene", 0}};
    Json scene = Json::object();
    if (!places.empty()) {  // glTF has no empty arrays
        scene["nodes"] = roots;
        json["nodes"] = nodes;
    }
    json["scenes"] = Json::array({scene});
    const auto bytes = make_glb(json.dump(), {});
    if (!bytes) return bytes.error().in(path);
    return write_file(path, *bytes);
}

}  // namespace tetralight
