// SPDX-License-Identifier: Apache-2.0
#define TINYGLTF_IMPLEMENTATION
#include <tetralight/bake/scene/detail/gltf_model.h>

#include <span>

#include <tetralight/bake/scene/detail/gltf_extensions.h>
#include <tetralight/bake/scene/detail/gltf_reflection_places.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>

namespace tetralight::detail {
namespace {

glm::dvec3 vec3_from(const std::vector<double>& numbers, glm::dvec3 otherwise) {
    return numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : otherwise;
}

GltfAttributes attributes_from(const std::map<std::string, int>& attributes) {
    GltfAttributes result;
    for (const auto& [name, accessor] : attributes) result[name] = index_from(accessor);
    return result;
}

GltfBufferView converted(const tinygltf::BufferView& view) {
    return {index_from(view.buffer), view.byteOffset, view.byteLength, view.byteStride, {}};
}

GltfAccessor converted(const tinygltf::Accessor& accessor) {
    GltfAccessor result;
    result.buffer_view = index_from(accessor.bufferView);
    result.byte_offset = accessor.byteOffset;
    result.component_type = static_cast<uint32_t>(accessor.componentType);
    if (accessor.type == TINYGLTF_TYPE_SCALAR) result.component_count = 1;
    if (accessor.type >= TINYGLTF_TYPE_VEC2 && accessor.type <= TINYGLTF_TYPE_VEC4) {
        result.component_count = static_cast<uint32_t>(accessor.type);
    }
    result.is_normalized = accessor.normalized;
    result.count = accessor.count;
    const auto& sparse = accessor.sparse;
    if (!sparse.isSparse) return result;
    // tinygltf stores these as int: a value that does not fit becomes about 4 billion, out of
    // range.
    result.sparse = {static_cast<uint32_t>(sparse.count),
                     index_from(sparse.indices.bufferView),
                     static_cast<uint32_t>(sparse.indices.byteOffset),
                     static_cast<uint32_t>(sparse.indices.componentType),
                     index_from(sparse.values.bufferView),
                     static_cast<uint32_t>(sparse.values.byteOffset)};
    return result;
}

GltfMesh converted(const tinygltf::Mesh& mesh) {
    GltfMesh result;
    result.name = mesh.name;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        result.primitives.push_back({attributes_from(primitive.attributes),
                                     index_from(primitive.indices),
                                     index_from(primitive.material),
                                     static_cast<uint32_t>(primitive.mode),
                                     {},
                                     {}});
    }
    return result;
}

GltfMaterial converted(const tinygltf::Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    GltfMaterial result;
    result.name = material.name;
    for (int i = 0; i < 4; ++i) result.base_color[i] = pbr.baseColorFactor[static_cast<size_t>(i)];
    result.metallic = pbr.metallicFactor;
    result.roughness = pbr.roughnessFactor;
    result.emissive_factor = vec3_from(material.emissiveFactor, glm::dvec3(0.0));
    const auto* strength = find_extension(material.extensions, "KHR_materials_emissive_strength");
    if (strength != nullptr) result.emissive_strength = number_at(*strength, "emissiveStrength", 1);
    result.alpha_mode = material.alphaMode;
    result.alpha_cutoff = material.alphaCutoff;
    result.is_double_sided = material.doubleSided;
    result.base_color_texture = texture_use_from(pbr.baseColorTexture);
    result.is_unlit = find_extension(material.extensions, "KHR_materials_unlit") != nullptr;
    result.bake_emission = bake_emission_from(material.extras);
    result.metallic_roughness_texture = texture_use_from(pbr.metallicRoughnessTexture);
    result.emission_texture = texture_use_from(material.emissiveTexture);
    result.normal_texture = texture_use_from(material.normalTexture);
    result.normal_scale = material.normalTexture.scale;
    return result;
}

GltfTexture converted(const tinygltf::Texture& texture) {
    return {texture.name, index_from(texture.source), index_from(texture.sampler), kNoIndex};
}

GltfImage converted(const tinygltf::Image& image) {
    const auto bytes = std::as_bytes(std::span(image.image));
    return {image.name, image.uri, index_from(image.bufferView), {bytes.begin(), bytes.end()}};
}

GltfSampler converted(const tinygltf::Sampler& sampler) {
    return {static_cast<uint32_t>(sampler.wrapS), static_cast<uint32_t>(sampler.wrapT)};
}

GltfLight converted(const tinygltf::Light& light) {
    return {light.name,
            light.type,
            vec3_from(light.color, glm::dvec3(1.0)),
            light.intensity,
            light.range,
            light.spot.innerConeAngle,
            light.spot.outerConeAngle,
            light_extras_from(light.extras)};
}

GltfCamera converted(const tinygltf::Camera& camera) {
    const bool is_perspective = camera.type == "perspective";
    return {camera.name, is_perspective ? std::optional(camera.perspective.yfov) : std::nullopt,
            std::nullopt};
}

glm::dmat4 matrix_from(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        return matrix;
    }
    const auto& q = node.rotation;
    const glm::dquat rotation =
        q.size() == 4 ? glm::dquat(q[3], q[0], q[1], q[2]) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    return compose_transform(vec3_from(node.translation, glm::dvec3(0.0)), rotation,
                             vec3_from(node.scale, glm::dvec3(1.0)));
}

GltfNode converted(const tinygltf::Node& node) {
    GltfNode result;
    result.name = node.name;
    result.parent_from_node = matrix_from(node);
    for (const int child : node.children) result.children.push_back(index_from(child));
    result.mesh = index_from(node.mesh);
    result.camera = index_from(node.camera);
    result.skin = index_from(node.skin);
    if (const auto* light = find_extension(node.extensions, "KHR_lights_punctual")) {
        result.light = index_from(light->Get("light").GetNumberAsInt());
        result.light_extras = light_extras_from(node.extras);
    }
    if (const auto* instancing = find_extension(node.extensions, "EXT_mesh_gpu_instancing")) {
        result.instancing.emplace();
        if (instancing->Has("attributes")) {  // an empty object is dropped
            for (const auto& [name, value] :
                 instancing->Get("attributes").Get<tinygltf::Value::Object>()) {
                (*result.instancing)[name] = index_from(value.GetNumberAsInt());
            }
        }
    }
    result.contributes_gi = boolean_extra(node.extras, "contribute_gi");
    result.is_walkable = boolean_extra(node.extras, "walkable");
    result.is_in_reflections = boolean_extra(node.extras, "in_reflections");
    result.receive_gi = string_extra(node.extras, "receive_gi");
    result.lightmap_scale = number_extra(node.extras, "lightmap_scale");
    result.stitches_seams = boolean_extra(node.extras, "stitch_seams");
    result.light_probes = string_extra(node.extras, "light_probes");
    result.probe_anchor = string_extra(node.extras, "probe_anchor");
    result.is_probe_group = boolean_extra(node.extras, "light_probe_group").value_or(false);
    result.dering = boolean_extra(node.extras, "dering").value_or(false);
    result.rendering_layers = rendering_layers_extra(node.extras);
    result.probe_adjustment = adjustment_from(node.extras);
    result.reflection_probe = reflection_probe_from(node.extras_json_string);
    result.portal = vec2_extra(node.extras, "portal");
    return result;
}

template <class Target, class Source>
std::vector<Target> all_converted(const std::vector<Source>& sources) {
    std::vector<Target> targets;
    targets.reserve(sources.size());
    for (const Source& source : sources) targets.push_back(converted(source));
    return targets;
}

const tinygltf::Scene* default_scene(const tinygltf::Model& model) {
    if (model.scenes.empty()) return nullptr;
    return &model.scenes[static_cast<size_t>(model.defaultScene < 0 ? 0 : model.defaultScene)];
}

std::optional<std::vector<uint32_t>> scene_roots(const tinygltf::Model& model) {
    const tinygltf::Scene* scene = default_scene(model);
    if (scene == nullptr) return std::nullopt;
    std::vector<uint32_t> roots;
    for (const int node : scene->nodes) roots.push_back(index_from(node));
    return roots;
}

std::optional<glm::dvec3> sky_radiance(const tinygltf::Model& model) {
    const tinygltf::Scene* scene = default_scene(model);
    if (scene == nullptr || !scene->extras.Has("sky")) return std::nullopt;
    const tinygltf::Value& sky = scene->extras.Get("sky");
    if (!sky.Has("radiance")) return std::nullopt;
    const tinygltf::Value& radiance = sky.Get("radiance");
    return glm::dvec3(radiance.Get(0).GetNumberAsDouble(), radiance.Get(1).GetNumberAsDouble(),
                      radiance.Get(2).GetNumberAsDouble());
}

}  // namespace

GltfDocument document_from(tinygltf::Model model, const std::string& path) {
    GltfDocument document;
    document.path = path;
    for (tinygltf::Buffer& buffer : model.buffers)
        document.buffers.push_back(std::move(buffer.data));
    document.buffer_views = all_converted<GltfBufferView>(model.bufferViews);
    document.accessors = all_converted<GltfAccessor>(model.accessors);
    document.meshes = all_converted<GltfMesh>(model.meshes);
    document.materials = all_converted<GltfMaterial>(model.materials);
    document.textures = all_converted<GltfTexture>(model.textures);
    document.images = all_converted<GltfImage>(model.images);
    document.samplers = all_converted<GltfSampler>(model.samplers);
    document.lights = all_converted<GltfLight>(model.lights);
    document.cameras = all_converted<GltfCamera>(model.cameras);
    document.nodes = all_converted<GltfNode>(model.nodes);
    document.scene_roots = scene_roots(model);
    if (model.defaultScene > 0) document.scene = static_cast<uint32_t>(model.defaultScene);
    document.sky_radiance = sky_radiance(model);
    return document;
}

}  // namespace tetralight::detail
