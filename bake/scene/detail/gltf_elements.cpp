// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_elements.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include <tetralight/bake/scene/detail/gltf_extras.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

constexpr uint32_t kRepeat = 10497;

uint32_t small_size_at(const json& value, std::string_view path, uint32_t otherwise) {
    return static_cast<uint32_t>(size_at(value, path, otherwise));
}

GltfBufferView buffer_view_from(const json& view) {
    GltfBufferView result{index_at(view, "buffer"),
                          size_at(view, "byteOffset", 0),
                          size_at(view, "byteLength", 0),
                          size_at(view, "byteStride", 0),
                          {}};
    const json* meshopt = find_json(view, "extensions/EXT_meshopt_compression");
    if (meshopt == nullptr) return result;
    result.meshopt = {index_at(*meshopt, "buffer"),         size_at(*meshopt, "byteOffset", 0),
                      size_at(*meshopt, "byteLength", 0),   size_at(*meshopt, "byteStride", 0),
                      size_at(*meshopt, "count", 0),        string_at(*meshopt, "mode"),
                      string_at(*meshopt, "filter", "NONE")};
    return result;
}

/// 0 for types that are not read.
uint32_t component_count_from(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    return type == "MAT4" ? 16 : 0;
}

GltfAccessor accessor_from(const json& accessor) {
    GltfAccessor result;
    result.buffer_view = index_at(accessor, "bufferView");
    result.byte_offset = size_at(accessor, "byteOffset", 0);
    result.component_type = small_size_at(accessor, "componentType", 0);
    result.component_count = component_count_from(string_at(accessor, "type"));
    result.is_normalized = boolean_at(accessor, "normalized").value_or(false);
    result.count = size_at(accessor, "count", 0);
    const json* sparse = find_json(accessor, "sparse");
    if (sparse == nullptr) return result;
    result.sparse = {size_at(*sparse, "count", 0),
                     index_at(*sparse, "indices/bufferView"),
                     size_at(*sparse, "indices/byteOffset", 0),
                     small_size_at(*sparse, "indices/componentType", 0),
                     index_at(*sparse, "values/bufferView"),
                     size_at(*sparse, "values/byteOffset", 0)};
    return result;
}

GltfPrimitive primitive_from(const json& primitive) {
    GltfPrimitive result;
    result.attributes = index_map_at(primitive, "attributes");
    result.indices = index_at(primitive, "indices");
    result.material = index_at(primitive, "material");
    result.mode = small_size_at(primitive, "mode", result.mode);
    for (const json& target : array_at(primitive, "targets")) {
        result.targets.push_back(index_map_at(target, ""));
    }
    if (const json* draco = find_json(primitive, "extensions/KHR_draco_mesh_compression")) {
        result.draco = {index_at(*draco, "bufferView"), index_map_at(*draco, "attributes")};
    }
    return result;
}

GltfMesh mesh_from(const json& mesh) {
    GltfMesh result{string_at(mesh, "name"), {}, numbers_at(mesh, "weights")};
    for (const json& primitive : array_at(mesh, "primitives")) {
        result.primitives.push_back(primitive_from(primitive));
    }
    return result;
}

std::optional<GltfSpecularGlossiness> specular_glossiness_from(const json& material) {
    const json* found = find_json(material, "extensions/KHR_materials_pbrSpecularGlossiness");
    if (found == nullptr) return std::nullopt;
    GltfSpecularGlossiness result;
    result.diffuse = vec4_at(*found, "diffuseFactor", result.diffuse);
    result.specular = vec3_at(*found, "specularFactor", result.specular);
    result.glossiness = number_at(*found, "glossinessFactor", result.glossiness);
    result.diffuse_texture = texture_use_at(*found, "diffuseTexture");
    result.specular_glossiness_texture = texture_use_at(*found, "specularGlossinessTexture");
    return result;
}

std::optional<GltfTransmission> transmission_from(const json& material) {
    const json* found = find_json(material, "extensions/KHR_materials_transmission");
    if (found == nullptr) return std::nullopt;
    return GltfTransmission{number_at(*found, "transmissionFactor", 0.0),
                            texture_use_at(*found, "transmissionTexture")};
}

GltfMaterial material_from(const json& material) {
    GltfMaterial result;
    result.name = string_at(material, "name");
    result.base_color =
        vec4_at(material, "pbrMetallicRoughness/baseColorFactor", result.base_color);
    result.metallic = number_at(material, "pbrMetallicRoughness/metallicFactor", result.metallic);
    result.roughness =
        number_at(material, "pbrMetallicRoughness/roughnessFactor", result.roughness);
    result.emissive_factor = vec3_at(material, "emissiveFactor", result.emissive_factor);
    result.emissive_strength =
        number_at(material, "extensions/KHR_materials_emissive_strength/emissiveStrength", 1.0);
    result.alpha_mode = string_at(material, "alphaMode", "OPAQUE");
    result.alpha_cutoff = number_at(material, "alphaCutoff", result.alpha_cutoff);
    result.is_double_sided = boolean_at(material, "doubleSided").value_or(false);
    result.is_unlit = find_json(material, "extensions/KHR_materials_unlit") != nullptr;
    result.bake_emission = bake_emission_from(material);
    result.base_color_texture = texture_use_at(material, "pbrMetallicRoughness/baseColorTexture");
    result.metallic_roughness_texture =
        texture_use_at(material, "pbrMetallicRoughness/metallicRoughnessTexture");
    result.emission_texture = texture_use_at(material, "emissiveTexture");
    result.normal_texture = texture_use_at(material, "normalTexture");
    result.normal_scale = number_at(material, "normalTexture/scale", 1.0);
    result.specular_glossiness = specular_glossiness_from(material);
    result.transmission = transmission_from(material);
    return result;
}

/// Files that have a PNG or JPEG image beside a WebP image are read with the latter
/// (EXT_texture_webp).
GltfTexture texture_from(const json& texture) {
    GltfTexture result{string_at(texture, "name"), index_at(texture, "source"),
                       index_at(texture, "sampler"),
                       index_at(texture, "extensions/KHR_texture_basisu/source")};
    const uint32_t webp = index_at(texture, "extensions/EXT_texture_webp/source");
    if (webp != kNoIndex) result.image = webp;
    return result;
}

/// `encoded` follows from the URI (gltf_buffers.h).
GltfImage image_from(const json& image) {
    return {string_at(image, "name"), string_at(image, "uri"), index_at(image, "bufferView"), {}};
}

GltfSampler sampler_from(const json& sampler) {
    return {small_size_at(sampler, "wrapS", kRepeat), small_size_at(sampler, "wrapT", kRepeat)};
}

GltfLight light_from(const json& light) {
    GltfLight result;
    result.name = string_at(light, "name");
    result.type = string_at(light, "type");
    result.color = vec3_at(light, "color", result.color);
    result.intensity = number_at(light, "intensity", result.intensity);
    result.range = number_at(light, "range", result.range);
    result.inner_cone_radians = number_at(light, "spot/innerConeAngle", 0.0);
    result.outer_cone_radians = number_at(light, "spot/outerConeAngle", 0.25 * std::numbers::pi);
    result.extras = light_extras_from(light);
    return result;
}

GltfAreaLight area_light_from(const json& light) {
    GltfAreaLight result;
    result.name = string_at(light, "name");
    result.type = string_at(light, "type");
    result.color = vec3_at(light, "color", result.color);
    if (light.contains("intensity")) result.intensity = number_at(light, "intensity", 0.0);
    result.size = number_at(light, "size", result.size);
    result.aspect = number_at(light, "rect/aspect", result.aspect);
    result.extras = light_extras_from(light);
    return result;
}

GltfCamera camera_from(const json& camera) {
    GltfCamera result;
    result.name = string_at(camera, "name");
    const std::string type = string_at(camera, "type");
    const double fov_y = number_at(camera, "perspective/yfov", 0.0);
    const bool is_fov = fov_y > 0.0 && fov_y < std::numbers::pi;
    if (type == "perspective" && is_fov) result.fov_y_radians = fov_y;
    const double half_height = number_at(camera, "orthographic/ymag", 0.0);
    if (type == "orthographic" && half_height > 0.0) result.half_height = half_height;
    return result;
}

GltfSkin skin_from(const json& skin) {
    return {string_at(skin, "name"), indices_at(skin, "joints"),
            index_at(skin, "inverseBindMatrices")};
}

GltfAnimation animation_from(const json& animation) {
    GltfAnimation result{string_at(animation, "name"), {}};
    const json& samplers = array_at(animation, "samplers");
    for (const json& channel : array_at(animation, "channels")) {
        const json& sampler = samplers[index_at(channel, "sampler")];
        result.channels.push_back({index_at(channel, "target/node"),
                                   string_at(channel, "target/path"), index_at(sampler, "input"),
                                   index_at(sampler, "output"),
                                   string_at(sampler, "interpolation", "LINEAR")});
    }
    return result;
}

void read_transform(const json& node, GltfNode& result) {
    result.translation = vec3_at(node, "translation", result.translation);
    const glm::dvec4 q = vec4_at(node, "rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0));
    result.rotation = glm::dquat(q.w, q.x, q.y, q.z);
    result.scale = vec3_at(node, "scale", result.scale);
    const auto matrix = numbers_at(node, "matrix");
    if (matrix.empty()) {
        result.parent_from_node =
            compose_transform(result.translation, result.rotation, result.scale);
        return;
    }
    for (int i = 0; i < 16; ++i) {
        result.parent_from_node[i / 4][i % 4] = matrix[static_cast<size_t>(i)];
    }
}

GltfNode node_from(const json& node) {
    GltfNode result;
    result.name = string_at(node, "name");
    read_transform(node, result);
    result.children = indices_at(node, "children");
    result.mesh = index_at(node, "mesh");
    result.camera = index_at(node, "camera");
    result.skin = index_at(node, "skin");
    result.weights = numbers_at(node, "weights");
    result.is_visible = boolean_at(node, "extensions/KHR_node_visibility/visible").value_or(true);
    result.light = index_at(node, "extensions/KHR_lights_punctual/light");
    result.area_light = index_at(node, "extensions/EXT_lights_area/light");
    const bool has_light = result.light != kNoIndex || result.area_light != kNoIndex;
    if (has_light) result.light_extras = light_extras_from(node);
    if (const json* instancing = find_json(node, "extensions/EXT_mesh_gpu_instancing")) {
        result.instancing = index_map_at(*instancing, "attributes");
    }
    read_node_extras(node, result);
    return result;
}

GltfImageBasedLight image_based_light_from(const json& light) {
    GltfImageBasedLight result;
    result.name = string_at(light, "name");
    result.is_sky = boolean_at(light, "extras/sky").value_or(true);
    const glm::dvec4 q = vec4_at(light, "rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0));
    result.rotation = glm::dquat(q.w, q.x, q.y, q.z);
    result.intensity = number_at(light, "intensity", result.intensity);
    for (const json& coefficient : array_at(light, "irradianceCoefficients")) {
        result.irradiance_coefficients.push_back(vec3_at(coefficient, "", glm::dvec3(0.0)));
    }
    result.image_size = small_size_at(light, "specularImageSize", 0);
    for (const json& level : array_at(light, "specularImages")) {
        auto& faces = result.images.emplace_back();
        for (size_t face = 0; face < faces.size(); ++face) faces[face] = level[face];
    }
    return result;
}

template <class Read>
auto read_all(const json& document, std::string_view path, Read read) {
    std::vector<decltype(read(document))> elements;
    const json& sources = array_at(document, path);
    elements.reserve(sources.size());
    for (const json& source : sources) elements.push_back(read(source));
    return elements;
}

}  // namespace

GltfDocument document_from(const json& source) {
    GltfDocument document;
    document.generator = string_at(source, "asset/generator");
    document.buffer_views = read_all(source, "bufferViews", buffer_view_from);
    document.accessors = read_all(source, "accessors", accessor_from);
    document.meshes = read_all(source, "meshes", mesh_from);
    document.materials = read_all(source, "materials", material_from);
    document.textures = read_all(source, "textures", texture_from);
    document.images = read_all(source, "images", image_from);
    document.samplers = read_all(source, "samplers", sampler_from);
    document.lights = read_all(source, "extensions/KHR_lights_punctual/lights", light_from);
    document.area_lights = read_all(source, "extensions/EXT_lights_area/lights", area_light_from);
    document.cameras = read_all(source, "cameras", camera_from);
    document.skins = read_all(source, "skins", skin_from);
    document.animations = read_all(source, "animations", animation_from);
    document.nodes = read_all(source, "nodes", node_from);
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        for (const json& name : array_at(source, list)) {
            if (name == "KHR_mesh_quantization") document.is_quantized = true;
        }
    }
    return document;
}

void choose_scene(const json& source, uint32_t scene, GltfDocument& document) {
    const auto& scenes = array_at(source, "scenes");
    if (scenes.empty()) return;
    const auto& chosen = scenes[scene];
    document.scene = scene;
    document.scene_roots = indices_at(chosen, "nodes");
    if (find_json(chosen, "extras/sky/radiance") != nullptr) {
        document.sky_radiance = vec3_at(chosen, "extras/sky/radiance", glm::dvec3(0.0));
    }
    const uint32_t light = index_at(chosen, "extensions/EXT_lights_image_based/light");
    if (light == kNoIndex) return;
    document.image_based_light =
        image_based_light_from(array_at(source, "extensions/EXT_lights_image_based/lights")[light]);
    document.image_based_light->index = light;
}

}  // namespace tetralight::detail
