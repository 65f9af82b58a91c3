// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/scene_contents.h>

#include <string>

#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

ScenePart read_part(const char* name) {
    ScenePart part;
    part.name = name;
    return part;
}

/// A row of elements that have names. `name_of` gives an element's name, which may be empty.
template <class T, class NameOf>
void add_named(const char* name, const std::vector<T>& elements, NameOf name_of, PartList& parts) {
    for (const T& element : elements) parts.add(read_part(name), name_of(element));
}

/// As messages write it: quoted; a number where there is no name.
std::string shown_name(const std::string& name, size_t index) {
    return name.empty() ? str_cat(index) : str_cat("\"", name, "\"");
}

const char* kind_of(const Light& light) {
    switch (light.type) {
        case LightType::Directional:
            return "directional lights";
        case LightType::Point:
            return "point lights";
        case LightType::Spot:
            return "spot lights";
        case LightType::Rectangle:
            return "rectangular lights";
        case LightType::Disc:
            return "disc lights";
    }
    return "lights";
}

void add_surfaces(const Scene& scene, PartList& parts) {
    uint64_t triangle_count = 0;
    for (const MeshInstance& instance : scene.instances) {
        triangle_count += scene.meshes[instance.mesh].indices.size() / 3;
    }
    parts.add_count(read_part("triangles"), triangle_count);
    for (const bool is_static : {true, false}) {
        for (size_t i = 0; i < scene.instances.size(); ++i) {
            const MeshInstance& instance = scene.instances[i];
            if (instance.contributes_gi != is_static) continue;
            parts.add(read_part(is_static ? "static objects" : "moving objects"),
                      shown_name(instance.name, i));
        }
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        parts.add(read_part("materials"), shown_name(scene.materials[i].name, i));
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        if (emission_source(scene.materials[i]).factor == glm::vec3(0.0f)) continue;
        parts.add(read_part("materials that emit light"), shown_name(scene.materials[i].name, i));
    }
    const auto size_of = [](const Texture& texture) {
        const std::string name = texture.name.empty() ? "" : str_cat("\"", texture.name, "\" ");
        return str_cat(name, texture.image.width, " x ", texture.image.height);
    };
    add_named("textures", scene.textures, size_of, parts);
    ScenePart normal_maps = read_part("normal maps");
    normal_maps.use = PartUse::Approximated;
    normal_maps.note =
        "bakes take the normals of the surfaces; pictures and `lightmap --normal-maps` take these";
    for (const Texture& map : scene.normal_maps) parts.add(normal_maps, size_of(map));
}

void add_lights(const Scene& scene, PartList& parts) {
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        parts.add(read_part(kind_of(scene.lights[i])), shown_name(scene.light_names[i], i));
    }
    const Environment& sky = scene.environment;
    if (sky.radiance == glm::vec3(0.0f)) return;
    const std::string size = str_cat("image of ", sky.image.width, " x ", sky.image.height);
    parts.add(read_part("sky"), sky.image.pixels.empty() ? "constant" : size);
}

}  // namespace

void add_contents(const Scene& scene, PartList& parts) {
    const auto name_of = [](const auto& element) { return str_cat("\"", element.name, "\""); };
    add_surfaces(scene, parts);
    add_lights(scene, parts);
    add_named("cameras", scene.cameras, name_of, parts);
    add_named("probe groups", scene.probe_groups, name_of, parts);
    uint64_t probe_count = 0;
    for (const ProbeGroup& group : scene.probe_groups) probe_count += group.positions.size();
    parts.add_count(read_part("probes"), probe_count);
    add_named("adjustment volumes", scene.probe_adjustments, name_of, parts);
    add_named("portals", scene.portals, name_of, parts);
    add_named("reflection probes", scene.reflection_places, name_of, parts);
}

}  // namespace tetralight::detail
