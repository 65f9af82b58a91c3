// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/read_gltf.h>

#include <algorithm>

#include <tetralight/bake/scene/detail/exporter_habits.h>
#include <tetralight/bake/scene/detail/gltf_animation.h>
#include <tetralight/bake/scene/detail/gltf_cameras.h>
#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_image_based_light.h>
#include <tetralight/bake/scene/detail/gltf_instances.h>
#include <tetralight/bake/scene/detail/gltf_lights.h>
#include <tetralight/bake/scene/detail/gltf_materials.h>
#include <tetralight/bake/scene/detail/gltf_memory.h>
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_motion_parts.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/gltf_portals.h>
#include <tetralight/bake/scene/detail/gltf_pose.h>
#include <tetralight/bake/scene/detail/gltf_probe_adjustments.h>
#include <tetralight/bake/scene/detail/gltf_probe_groups.h>
#include <tetralight/bake/scene/detail/gltf_reflection_places.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/detail/scene_contents.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

Status add_surfaces(const detail::GltfDocument& document, NormalMaps normal_maps, Scene& scene,
                    detail::GltfMeshes& meshes, detail::PartList& parts) {
    auto read = detail::read_meshes(document, normal_maps);
    if (!read) return read.error();
    const auto nodes = detail::flatten_nodes(document);
    if (!nodes) return nodes.error();
    const auto posed = detail::pose_meshes(document, *nodes, normal_maps, *read);
    if (!posed) return posed.error();
    auto materials = detail::read_materials(document, normal_maps);
    if (!materials) return materials.error();
    meshes = std::move(*read);
    scene.meshes = std::move(meshes.meshes);
    detail::ignore_vertex_alpha(*materials, scene.meshes);
    scene.materials = std::move(materials->materials);
    scene.textures = std::move(materials->textures);
    scene.normal_maps = std::move(materials->normal_maps);
    parts.append(materials->parts);
    detail::assign_default_material(scene.materials, scene.meshes);
    parts.append(meshes.parts.parts());
    return Ok{};
}

void add_skins_without_joints(const detail::GltfDocument& document,
                              std::span<const detail::GltfWorldNode> nodes,
                              detail::PartList& parts) {
    for (const detail::GltfWorldNode& placed : nodes) {
        const detail::GltfNode& node = document.nodes[placed.node];
        const bool is_left_out = node.skin != kNoIndex && !detail::is_skinned(document, node);
        if (!is_left_out || !placed.contributes_gi) continue;
        parts.add_left_out("skins of meshes without joints",
                           "are left out; the meshes stand where their nodes do", true,
                           detail::gltf_place("node", placed.node, node.name));
    }
}

void add_flat_groups(const detail::GltfDocument& document,
                     std::span<const detail::GltfWorldNode> nodes, detail::PartList& parts) {
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "probe groups scaled to 0";
    part.note = "their probes lie in a plane, on a line or at a point";
    part.remedy = "give the group a scale above 0 on every axis";
    part.changes_light = true;
    for (const detail::GltfWorldNode& placed : nodes) {
        const detail::GltfNode& node = document.nodes[placed.node];
        if (!node.is_probe_group || detail::is_invertible(placed.world_from_node)) continue;
        parts.add(part, detail::gltf_place("node", placed.node, node.name));
    }
}

Status add_nodes(const detail::GltfDocument& document, const detail::GltfMeshes& meshes,
                 Scene& scene, detail::PartList& parts) {
    const auto nodes = detail::flatten_nodes(document);
    if (!nodes) return nodes.error();
    auto lights = detail::read_lights(document, *nodes);
    if (!lights) return lights.error();
    auto probe_groups = detail::read_gltf_probe_groups(document, *nodes);
    if (!probe_groups) return probe_groups.error();
    auto adjustments = detail::read_gltf_probe_adjustments(document, *nodes);
    if (!adjustments) return adjustments.error();
    auto portals = detail::read_gltf_portals(document, *nodes);
    if (!portals) return portals.error();
    auto places = detail::read_gltf_reflection_places(document, *nodes);
    if (!places) return places.error();
    auto instances =
        detail::read_instances(document, *nodes, probe_groups->is_probe, meshes, parts);
    if (!instances) return instances.error();
    scene.lights = std::move(lights->lights);
    scene.light_names = std::move(lights->names);
    scene.probe_groups = std::move(probe_groups->groups);
    scene.probe_adjustments = std::move(*adjustments);
    scene.portals = std::move(*portals);
    scene.reflection_places = std::move(*places);
    scene.instances = std::move(*instances);
    auto scene_nodes = detail::scene_nodes(document, *nodes);
    if (!scene_nodes) return scene_nodes.error();
    scene.nodes = std::move(*scene_nodes);
    parts.append(lights->parts.parts());
    scene.cameras = detail::read_cameras(document, *nodes, parts);
    add_flat_groups(document, *nodes, parts);
    add_skins_without_joints(document, *nodes, parts);
    return Ok{};
}

Status add_constant_sky(const detail::GltfDocument& document, Scene& scene) {
    const glm::dvec3& radiance = *document.sky_radiance;
    scene.environment.radiance = glm::vec3(radiance);
    if (std::min({radiance.x, radiance.y, radiance.z}) >= 0.0) return Ok{};
    const std::string value = str_cat(radiance.x, ", ", radiance.y, ", ", radiance.z);
    return Error{ErrorCode::InvalidArgument,
                 str_cat("scenes[", document.scene, "].extras.sky.radiance"), value,
                 str_cat("scene: extras.sky.radiance (", value, ") is negative")};
}

/// The sky of the scene's extras, else its image-based light.
Status add_sky(const detail::GltfDocument& document, Scene& scene, detail::PartList& parts) {
    if (document.sky_radiance) return add_constant_sky(document, scene);
    if (!document.image_based_light || !document.image_based_light->is_sky) return Ok{};
    auto sky = detail::read_image_based_light(document, *document.image_based_light);
    if (!sky) return sky.error();
    scene.environment = std::move(sky->environment);
    parts.append(sky->parts.parts());
    return Ok{};
}

/// `parts`: what is not read as it is.
Status add_all(const detail::GltfDocument& document, const SceneReading& reading, Scene& scene,
               detail::PartList& parts) {
    detail::GltfMeshes meshes;
    const auto surfaces = add_surfaces(document, reading.normal_maps, scene, meshes, parts);
    if (!surfaces) return surfaces;
    const auto sky = add_sky(document, scene, parts);
    if (!sky) return sky;
    return add_nodes(document, meshes, scene, parts);
}

/// The table of what was read, and warnings of what is left out and changes the light.
void add_parts(const detail::GltfDocument& document, const SceneReading& reading,
               const detail::PartList& not_read, Scene& scene) {
    detail::PartList parts;
    detail::add_contents(scene, parts);
    if (const auto nodes = detail::flatten_nodes(document))
        detail::add_motion_parts(document, *nodes, parts);
    if (reading.light_unit == LightUnit::Lux) {
        detail::add_light_unit(document, scene, reading.has_other_sky, parts);
    }
    detail::add_length_unit(scene, parts);
    parts.append(not_read.parts());
    parts.append(document.parts);
    scene.parts = parts.parts();
    for (const ScenePart& part : scene.parts) {
        if (part.changes_light) scene.warnings.push_back(detail::part_warning(part));
    }
}

/// Intensities that were written in lumens of watts, in watts.
void divide_intensities(detail::GltfDocument& document) {
    for (detail::GltfLight& light : document.lights) light.intensity /= kLumensPerWatt;
    for (detail::GltfAreaLight& light : document.area_lights) {
        if (light.intensity) *light.intensity /= kLumensPerWatt;
    }
}

}  // namespace

Result<Scene> read_gltf(const std::string& path, const SceneReading& reading) {
    auto document = detail::read_posed_document(path, reading);
    if (!document) return document.error();
    if (reading.light_unit == LightUnit::Watt) divide_intensities(*document);
    Scene scene;
    scene.choice = {reading.scene, reading.time, reading.animation,
                    reading.light_unit == LightUnit::Watt};
    scene.memory = document->memory;
    scene.memory.image_bytes = detail::image_memory(*document, reading.normal_maps);
    const auto fits = detail::check_reading_memory(scene.memory);
    if (!fits) return fits.error().in(path);
    scene.warnings = document->warnings;
    detail::PartList not_read;
    const auto status = add_all(*document, reading, scene, not_read);
    if (!status) return status.error().in(path);
    add_parts(*document, reading, not_read, scene);
    for (std::string& warning : scene.warnings) warning.insert(0, path + ": ");
    return scene;
}

}  // namespace tetralight
