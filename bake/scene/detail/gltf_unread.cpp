// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_unread.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_extension_table.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/bake/scene/detail/gltf_texture_coordinates.h>
#include <tetralight/bake/scene/detail/meant_name.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

void add_extension(const std::string& name, const std::string& element, PartList& parts) {
    const GltfExtension* known = find_gltf_extension(name);
    ScenePart part;
    part.name = name;
    if (known == nullptr) {
        part.use = PartUse::Ignored;
        part.note = "is not known here; what it changes of surfaces and lights is left out";
        part.changes_light = true;
    } else {
        part.use = known->use;
        part.note = known->note;
        part.remedy = known->remedy;
        part.changes_light = known->changes_light;
    }
    parts.add(part, element);
}

/// Why the scene's image-based light is not its sky; empty if it is.
std::string_view reason_for_no_sky(const GltfDocument& document) {
    if (!document.image_based_light) return "";
    if (document.sky_radiance) return "extras.sky of the scene is read instead";
    if (document.image_based_light->is_sky) return "";
    return "is the light of a place in the scene, and not its sky: its extras.sky is false";
}

/// Adds an extension that has another image for a texture, which has no image that is read.
void add_only_image(const std::string& name, const std::string& element, PartList& parts) {
    const GltfExtension* known = find_gltf_extension(name);
    ScenePart part;
    part.name = name;
    part.use = PartUse::Ignored;
    part.note = "there is no PNG, JPEG or WebP image beside it; the texture is left out";
    part.remedy = known->remedy;
    parts.add(part, element);
}

/// True if an extension has the only image of a texture, in a format that is not read.
bool is_only_image(const std::string& name, const GltfSection& section, const json& element) {
    if (std::string_view(section.name) != "textures" || element.contains("source")) return false;
    if (find_json(element, "extensions/EXT_texture_webp/source") != nullptr) return false;
    return name == "EXT_texture_avif" || name == "KHR_texture_basisu" || name == "MSFT_texture_dds";
}

/// True for extensions whose factor is 0, as it is by default.
bool is_without_effect(const std::string& name, const json& element) {
    const auto factor = [&](const char* member) {
        return number_at(element, str_cat("extensions/", name, "/", member), 0.0);
    };
    if (name == "KHR_materials_volume") return factor("thicknessFactor") == 0.0;
    return name == "KHR_materials_transmission" && factor("transmissionFactor") == 0.0;
}

/// Why a material with KHR_materials_transmission lets no light through; empty if it does.
std::string_view reason_for_opacity(const std::string& name, const json& material) {
    if (name != "KHR_materials_transmission") return "";
    const json* extensions = find_json(material, "extensions");
    if (extensions->contains("KHR_materials_unlit")) return "unlit materials let no light through";
    const bool is_metal =
        !extensions->contains("KHR_materials_pbrSpecularGlossiness") &&
        number_at(material, "pbrMetallicRoughness/metallicFactor", 1.0) >= 1.0 &&
        find_json(material, "pbrMetallicRoughness/metallicRoughnessTexture") == nullptr;
    return is_metal ? "metals let no light through: metallicFactor is 1" : "";
}

/// Why lights of a file are not in the scene; empty if they may be.
std::string_view reason_for_no_lights(const std::string& name, const json& source) {
    const auto has_lights = [&] {
        return !array_at(source, str_cat("extensions/", name, "/lights")).empty();
    };
    if (name == "EXT_lights_image_based" && has_lights())
        return "the scene names none of its lights";
    const bool is_of_nodes = name == "KHR_lights_punctual" || name == "EXT_lights_area";
    return is_of_nodes && has_lights() ? "no node has one of its lights" : "";
}

/// The names of all extensions of a value and of what is in it, but not in its extras.
void find_extensions(const json& value, std::set<std::string>& names) {
    if (!value.is_structured()) return;
    for (const auto& [key, member] : value.items()) {
        if (value.is_object() && key == "extras") continue;
        if (value.is_object() && key == "extensions" && member.is_object()) {
            for (const auto& [name, extension] : member.items()) names.insert(name);
        }
        find_extensions(member, names);
    }
}

void add_extensions(const json& source, const GltfDocument& document, PartList& parts) {
    const json& scenes = array_at(source, "scenes");
    const json* scene = scenes.empty() ? nullptr : &scenes[document.scene];
    std::set<std::string> seen;
    for_each_element(
        source, [&](const GltfSection& section, const json& element, const std::string& place) {
            std::set<std::string> names;
            find_extensions(element, names);
            const auto no_sky = &element == scene ? reason_for_no_sky(document) : "";
            for (const std::string& name : names) {
                if (name == "EXT_lights_image_based" && !no_sky.empty()) {
                    parts.add_left_out(name, std::string(no_sky), false, place);
                } else if (is_only_image(name, section, element)) {
                    add_only_image(name, place, parts);
                } else if (is_without_effect(name, element)) {
                    ScenePart part;
                    part.name = name;
                    parts.add(part, place);
                } else if (const auto opaque = reason_for_opacity(name, element); !opaque.empty()) {
                    parts.add_left_out(name, std::string(opaque), false, place);
                } else {
                    add_extension(name, place, parts);
                }
            }
            seen.insert(names.begin(), names.end());
        });
    std::set<std::string> of_file;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        for (const json& name : array_at(source, list)) {
            if (name.is_string()) of_file.insert(name.get<std::string>());
        }
    }
    if (const json* extensions = find_json(source, "extensions"); extensions != nullptr) {
        for (const auto& [name, extension] : extensions->items()) of_file.insert(name);
    }
    for (const std::string& name : of_file) {
        if (seen.contains(name)) continue;
        if (const auto reason = reason_for_no_lights(name, source); !reason.empty()) {
            const bool may_be_sky = name == "EXT_lights_image_based" && !document.sky_radiance;
            parts.add_left_out(name, std::string(reason), may_be_sky, "the file");
        } else {
            add_extension(name, "the file", parts);
        }
    }
}

bool begins_with_any(const std::string& name, std::initializer_list<std::string_view> beginnings) {
    return std::ranges::any_of(beginnings,
                               [&](std::string_view begin) { return name.starts_with(begin); });
}

/// The attributes that are read.
const std::vector<std::string>& known_attributes() {
    static const std::vector<std::string> kNames{"POSITION",   "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                                 "TEXCOORD_1", "COLOR_0",  "JOINTS_0", "WEIGHTS_0",
                                                 "JOINTS_1",   "WEIGHTS_1"};
    return kNames;
}

/// Attributes of a primitive that are not read.
void add_attributes(const GltfPrimitive& primitive, const std::string& place, PartList& parts) {
    for (const auto& [name, accessor] : primitive.attributes) {
        if (std::ranges::find(known_attributes(), name) != known_attributes().end()) continue;
        ScenePart part{PartUse::Ignored, "attribute " + name, 0, {}, "", "", false};
        if (begins_with_any(name, {"COLOR_"})) part.note = "only COLOR_0 counts";
        if (begins_with_any(name, {"TEXCOORD_"})) part.note = "only sets 0 and 1 are read";
        if (begins_with_any(name, {"JOINTS_", "WEIGHTS_"})) {
            part.note = "only the first eight joints of a vertex count";
            part.changes_light = true;
        }
        if (name.starts_with('_')) part.note = "belongs to the program that wrote the file";
        if (part.note.empty()) {
            part.note = "is not an attribute of glTF 2.0";
            const std::string near = meant_name(name, known_attributes());
            if (!near.empty()) part.remedy = str_cat("did you mean \"", near, "\"?");
            part.changes_light = !near.empty();
        }
        parts.add(part, place);
    }
    for (const GltfAttributes& target : primitive.targets) {
        for (const auto& [name, accessor] : target) {
            if (begins_with_any(name, {"POSITION", "NORMAL", "TANGENT"})) continue;
            parts.add_left_out("morphed " + name, "is read without its morphing",
                               begins_with_any(name, {"COLOR_0", "TEXCOORD_0"}), place);
        }
    }
}

/// What EXT_mesh_gpu_instancing has that is not read.
void add_instancing(const GltfDocument& document, PartList& parts) {
    for (size_t i = 0; i < document.nodes.size(); ++i) {
        const GltfNode& node = document.nodes[i];
        if (!node.instancing) continue;
        const std::string place = gltf_place("node", i, node.name);
        for (const auto& [name, accessor] : *node.instancing) {
            if (name == "TRANSLATION" || name == "ROTATION" || name == "SCALE") continue;
            ScenePart part{
                PartUse::Ignored, "attribute " + name + " of instances", 0, {}, "", "", false};
            part.note = name.starts_with('_') ? "belongs to the program that wrote the file"
                                              : "is no attribute of EXT_mesh_gpu_instancing";
            if (name == "_COLOR_0") {
                part.note = "instances have the colours of their mesh; some viewers change them";
                part.changes_light = true;
            }
            parts.add(part, place);
        }
        if (!is_skinned(document, node)) continue;
        parts.add_left_out("instances of a node with a skin",
                           "the mesh stands once, where its skin has it", true, place);
    }
}

/// Meshes of nodes that are groups of probes, whose points are read.
std::set<uint32_t> probe_meshes(const GltfDocument& document) {
    std::set<uint32_t> meshes;
    for (const GltfNode& node : document.nodes) {
        if (node.is_probe_group) meshes.insert(node.mesh);
    }
    return meshes;
}

void add_primitives(const GltfDocument& document, PartList& parts) {
    const std::set<uint32_t> of_probes = probe_meshes(document);
    for (uint32_t i = 0; i < document.meshes.size(); ++i) {
        const std::string place = gltf_place("mesh", i, document.meshes[i].name);
        for (const GltfPrimitive& primitive : document.meshes[i].primitives) {
            add_attributes(primitive, place, parts);
            if (primitive.mode >= 4 || of_probes.contains(i)) continue;
            parts.add_left_out(primitive.mode == 0 ? "points" : "lines",
                               "have no area that reflects light", false, place);
        }
    }
}

void add_materials(const json& source, PartList& parts) {
    for_each_element(source, [&](const GltfSection& section, const json& element,
                                 const std::string& place) {
        const std::string_view kind = section.name;
        if (kind == "materials" && element.contains("occlusionTexture")) {
            parts.add_left_out("occlusion textures", "bakes find occlusion by rays", false, place);
        }
        constexpr uint64_t kNearest = 9728;
        if (kind == "samplers" && element.value("magFilter", json()) == kNearest) {
            parts.add({PartUse::Approximated,
                       "samplers with NEAREST",
                       0,
                       {},
                       "textures are filtered bilinearly",
                       "",
                       false},
                      place);
        }
    });
}

void add_cameras(const GltfDocument& document, const json& source, PartList& parts) {
    for (uint32_t i = 0; i < document.cameras.size(); ++i) {
        const GltfCamera& camera = document.cameras[i];
        if (camera.fov_y_radians || camera.half_height) continue;
        const json& element = array_at(source, "cameras")[i];
        const std::string type = string_at(element, "type");
        std::string note = str_cat("type \"", type, "\" is neither perspective nor orthographic");
        if (type == "orthographic") {
            note =
                str_cat("ymag ", number_at(element, "orthographic/ymag", 0.0), " is not above 0");
        } else if (type == "perspective") {
            note = str_cat("yfov ", number_at(element, "perspective/yfov", 0.0),
                           " is not between 0 and π radians");
        }
        parts.add_left_out("cameras", note, false, gltf_place("camera", i, camera.name));
    }
}

/// Nodes that the scene does not lead to.
void add_other_nodes(const GltfDocument& document, PartList& parts) {
    if (!document.scene_roots) return;
    std::vector<bool> is_reached(document.nodes.size(), false);
    std::vector<uint32_t> pending = *document.scene_roots;
    while (!pending.empty()) {
        const uint32_t node = pending.back();
        pending.pop_back();
        if (is_reached[node]) continue;
        is_reached[node] = true;
        const auto& children = document.nodes[node].children;
        pending.insert(pending.end(), children.begin(), children.end());
    }
    for (size_t i = 0; i < document.nodes.size(); ++i) {
        if (is_reached[i]) continue;
        parts.add_left_out("nodes outside of the scene", "no node of the scene leads to them",
                           false, gltf_place("node", i, document.nodes[i].name));
    }
}

void add_other_scenes(const json& source, const GltfDocument& document, PartList& parts) {
    const json& scenes = array_at(source, "scenes");
    for (size_t i = 0; i < scenes.size(); ++i) {
        if (i == document.scene) continue;
        parts.add({PartUse::Ignored,
                   "other scenes",
                   0,
                   {},
                   str_cat("scene ", document.scene, " is read"),
                   "--scene-name reads another one",
                   false},
                  gltf_place("scene", i, string_at(scenes[i], "name")));
    }
}

}  // namespace

void add_unread_parts(const json& source, const GltfDocument& document, PartList& parts) {
    add_extensions(source, document, parts);
    add_primitives(document, parts);
    add_instancing(document, parts);
    add_missing_coordinates(document, parts);
    add_materials(source, parts);
    add_cameras(document, source, parts);
    add_other_scenes(source, document, parts);
    add_other_nodes(document, parts);
}

}  // namespace tetralight::detail
