// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_memory.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/gltf_buffers.h>
#include <tetralight/bake/scene/detail/gltf_draco.h>
#include <tetralight/bake/scene/detail/gltf_image_based_light.h>
#include <tetralight/bake/scene/detail/gltf_images.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_meshopt.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Bytes of parsed JSON for a byte of its text, in files of many small elements.
constexpr uint64_t kJsonBytesPerByte = 7;

/// What Draco's decoder has for a triangle of the mesh that it decodes, until it is decoded.
constexpr uint64_t kDracoBytesPerTriangle = 100;

/// The bytes that read_buffers() reads for a buffer.
uint64_t buffer_size(const nlohmann::json& buffer, const std::string& scene_path) {
    if (is_fallback_buffer(buffer)) return 0;
    const std::string uri = string_at(buffer, "uri");
    if (uri.empty()) return size_at(buffer, "byteLength", 0);
    if (is_data_uri(uri)) return uri.size() / 4 * 3;
    const auto path = path_from_uri(uri, scene_path);
    std::error_code error;
    const uint64_t size = path ? std::filesystem::file_size(*path, error) : 0;
    return error ? 0 : size;
}

uint64_t encoded_buffer_bytes(const nlohmann::json& source, const std::string& scene_path,
                              uint64_t file_size) {
    uint64_t sum = 0;
    for (const nlohmann::json& buffer : array_at(source, "buffers")) {
        const bool is_in_file = string_at(buffer, "uri").empty();
        const uint64_t size = buffer_size(buffer, scene_path);
        sum = add_bytes(sum, is_in_file ? std::min(size, file_size) : size);
    }
    return sum;
}

/// The elements of an accessor that are read: the reader refuses more than its buffer view has.
uint64_t element_count(const GltfDocument& document, uint32_t accessor) {
    const GltfAccessor& source = document.accessors[accessor];
    const bool is_zero = source.buffer_view == kNoIndex;
    return std::min(source.count, is_zero ? kMaxZeroElements
                                          : document.buffer_views[source.buffer_view].byte_length);
}

/// Those of an accessor that Draco may have compressed.
uint64_t element_count(const GltfDocument& document, const GltfPrimitive& primitive,
                       uint32_t accessor) {
    return primitive.draco ? document.accessors[accessor].count : element_count(document, accessor);
}

uint64_t attribute_count(const GltfDocument& document, const GltfPrimitive& primitive,
                         const char* name) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) return 0;
    return element_count(document, primitive, attribute->second);
}

uint64_t primitive_bytes(const GltfDocument& document, const GltfPrimitive& primitive) {
    constexpr std::pair<const char*, uint64_t> kAttributes[] = {
        {"POSITION", sizeof(glm::vec3)},   {"NORMAL", sizeof(glm::vec3)},
        {"TEXCOORD_0", sizeof(glm::vec2)}, {"TEXCOORD_1", sizeof(glm::vec2)},
        {"COLOR_0", sizeof(glm::vec4)},    {"TANGENT", sizeof(glm::vec4)}};
    uint64_t sum = sizeof(Mesh);
    if (!has_triangles(primitive)) return sum;
    for (const auto& [name, size] : kAttributes)
        sum = add_bytes(sum, attribute_count(document, primitive, name), size);
    const uint64_t corners = primitive.indices == kNoIndex
                                 ? attribute_count(document, primitive, "POSITION")
                                 : element_count(document, primitive, primitive.indices);
    return add_bytes(sum, corners, sizeof(uint32_t));
}

uint64_t mesh_bytes(const GltfDocument& document, const GltfMesh& mesh) {
    uint64_t sum = 0;
    for (const GltfPrimitive& primitive : mesh.primitives)
        sum = add_bytes(sum, primitive_bytes(document, primitive));
    return sum;
}

/// What decoding the largest Draco mesh takes beside its result.
uint64_t draco_decoder_bytes(const GltfDocument& document) {
    uint64_t most = 0;
    for (const GltfMesh& mesh : document.meshes) {
        for (const GltfPrimitive& primitive : mesh.primitives) {
            if (!primitive.draco || primitive.indices == kNoIndex) continue;
            const uint64_t triangles = document.accessors[primitive.indices].count / 3;
            most = std::max(most, add_bytes(0, triangles, kDracoBytesPerTriangle));
        }
    }
    return most;
}

/// A node's instances, and its own vertices if a skin or morph targets move them.
uint64_t node_bytes(const GltfDocument& document, const GltfNode& node) {
    uint64_t sum = sizeof(SceneNode);
    if (node.mesh == kNoIndex) return sum;
    const GltfMesh& mesh = document.meshes[node.mesh];
    const auto has_targets = [](const GltfPrimitive& source) { return !source.targets.empty(); };
    if (node.skin != kNoIndex || std::ranges::any_of(mesh.primitives, has_targets))
        sum = add_bytes(sum, mesh_bytes(document, mesh));
    uint64_t instances = 1;
    if (node.instancing) {
        for (const auto& [name, accessor] : *node.instancing)
            instances = std::max(instances, element_count(document, accessor));
    }
    for (size_t i = 0; i < mesh.primitives.size(); ++i)
        sum = add_bytes(sum, instances, sizeof(MeshInstance));
    return sum;
}

/// The structures of the document itself.
uint64_t document_bytes(const GltfDocument& document) {
    return document.nodes.size() * sizeof(GltfNode) +
           document.accessors.size() * sizeof(GltfAccessor) +
           document.buffer_views.size() * sizeof(GltfBufferView) +
           document.materials.size() * sizeof(GltfMaterial);
}

constexpr uint64_t kBytesPerTexel = 4;

/// Texels of an image; 0 if its header does not tell.
uint64_t texel_count(const GltfDocument& document, uint32_t image) {
    const auto size = gltf_image_size(document, image);
    return size ? uint64_t{size->width} * size->height : 0;
}

/// For each material whose textures are converted, their images: a colour and a texture of factors
/// become as large as the largest of them.
std::vector<std::set<uint32_t>> converted_images(const GltfDocument& document) {
    std::vector<std::set<uint32_t>> converted;
    for (const GltfMaterial& material : document.materials) {
        if (material.is_unlit) continue;
        std::set<uint32_t> images;
        const auto add = [&](const TextureUse& use) {
            if (use.texture == kNoIndex) return;
            const uint32_t image = document.textures[use.texture].image;
            if (image != kNoIndex) images.insert(image);
        };
        if (material.specular_glossiness) {
            add(material.specular_glossiness->diffuse_texture);
            add(material.specular_glossiness->specular_glossiness_texture);
        }
        if (material.transmission && material.transmission->factor > 0.0) {
            add(material.base_color_texture);
            add(material.metallic_roughness_texture);
            add(material.transmission->texture);
        }
        if (!images.empty()) converted.push_back(std::move(images));
    }
    return converted;
}

/// The faces of an image-based light, and the sky that is made of them.
uint64_t sky_bytes(const GltfDocument& document) {
    const auto& light = document.image_based_light;
    if (document.sky_radiance || !light || !light->is_sky || light->images.empty()) return 0;
    uint64_t texels = 0;
    for (const uint32_t image : light->images[0])
        texels = add_bytes(texels, texel_count(document, image));
    const uint64_t rows = sky_rows(light->image_size);
    return add_bytes(add_bytes(0, texels, sizeof(glm::vec3)), 2 * rows * rows, sizeof(glm::vec3));
}

}  // namespace

SceneMemory geometry_memory(const nlohmann::json& source, const GltfDocument& document,
                            std::span<const std::byte> file) {
    SceneMemory memory;
    const uint64_t encoded = encoded_buffer_bytes(source, document.path, file.size());
    const uint64_t text = file.size() - std::min<uint64_t>(file.size(), encoded);
    memory.file_bytes = add_bytes(file.size(), text, kJsonBytesPerByte);
    memory.file_bytes = add_bytes(memory.file_bytes, draco_decoder_bytes(document));
    memory.buffer_bytes = add_bytes(encoded, document_bytes(document));
    memory.buffer_bytes = add_bytes(memory.buffer_bytes, meshopt_decoded_bytes(document));
    memory.buffer_bytes = add_bytes(memory.buffer_bytes, draco_decoded_bytes(document));
    for (const GltfMesh& mesh : document.meshes)
        memory.geometry_bytes = add_bytes(memory.geometry_bytes, mesh_bytes(document, mesh));
    for (const GltfNode& node : document.nodes)
        memory.geometry_bytes = add_bytes(memory.geometry_bytes, node_bytes(document, node));
    return memory;
}

uint64_t image_memory(const GltfDocument& document, NormalMaps normal_maps) {
    uint64_t sum = sky_bytes(document);
    for (const GltfImageUse& use : image_uses(document, normal_maps))
        sum = add_bytes(sum, texel_count(document, use.image), kBytesPerTexel);
    for (const std::set<uint32_t>& converted : converted_images(document)) {
        uint64_t texels = 0;
        for (const uint32_t image : converted)
            texels = std::max(texels, texel_count(document, image));
        sum = add_bytes(sum, texels, 2 * kBytesPerTexel);
    }
    return sum;
}

Status check_reading_memory(const SceneMemory& memory, uint64_t limit_bytes) {
    if (memory.peak_bytes() <= limit_bytes) return Ok{};
    return Error{
        ErrorCode::OutOfResources,
        str_cat("reading it needs about ", gigabytes(memory.peak_bytes()), " of memory (geometry ",
                gigabytes(add_bytes(memory.buffer_bytes, memory.geometry_bytes)), ", images ",
                gigabytes(memory.image_bytes), "), ", gigabytes(limit_bytes), " are free")};
}

}  // namespace tetralight::detail
