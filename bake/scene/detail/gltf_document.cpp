// SPDX-License-Identifier: Apache-2.0
#include "bake/scene/detail/gltf_document.h"

#include <cmath>
#include <exception>
#include <fstream>  // tiny_gltf.h needs it and leaves it out with TINYGLTF_NO_FS
#include <limits>
#include <new>
#include <span>
#include <string_view>

#include "bake/scene/detail/glb_container.h"
#include "bake/scene/detail/gltf_check.h"
#include "bake/scene/detail/gltf_transform.h"
#include "bake/scene/detail/gltf_uri.h"
#include "base/file.h"
#include "base/text.h"

// The only file that knows tinygltf. It parses and decodes base64; files are read, images are
// decoded and everything is checked by our own code.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

uint32_t index_from(int index) {
    return index < 0 ? kNoIndex : static_cast<uint32_t>(index);
}

bool pretend_file_exists(const std::string&, void*) {
    return true;  // what is missing is found out by reading, with the system's reason
}

std::string keep_path(const std::string& path, void*) {
    return path;
}

bool read_buffer_file(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                      void*) {
    const auto bytes = read_file(path);
    if (!bytes) {
        *error = bytes.error().message;
        return false;
    }
    const auto* first = reinterpret_cast<const unsigned char*>(bytes->data());
    out->assign(first, first + bytes->size());
    return true;
}

/// Keeps the encoded bytes of a data URI. Images in buffer views are found through the view.
bool keep_encoded_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                        const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// tinygltf's messages, which may have several lines and hold a whole data URI, as one short line.
std::string one_line(std::string message) {
    constexpr size_t kLongest = 200;
    while (!message.empty() && message.back() == '\n') message.pop_back();
    for (char& c : message) {
        if (c == '\n') c = ' ';
    }
    return message.size() <= kLongest ? message : message.substr(0, kLongest) + "...";
}

Result<tinygltf::Model> parse_model(Bytes bytes, const std::string& folder) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_encoded_image, nullptr);
    parser.SetFsCallbacks({pretend_file_exists, keep_path, read_buffer_file, nullptr, nullptr});
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto size = static_cast<unsigned>(bytes.size());
    const bool is_parsed =
        is_glb(bytes)
            ? parser.LoadBinaryFromMemory(&model, &error, &warning, first, size, folder)
            : parser.LoadASCIIFromString(&model, &error, &warning,
                                         reinterpret_cast<const char*>(first), size, folder);
    // A parsed model may come with errors too: of parts that check_gltf_json() passes over, since
    // nothing here reads them (a skin without matrices, say).
    if (is_parsed) return model;
    return Error{one_line(error.empty() ? "cannot parse glTF" : error)};
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

std::optional<bool> boolean_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    return extras.Get(key).Get<bool>();
}

std::optional<std::string> string_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    const tinygltf::Value& value = extras.Get(key);
    return value.IsString() ? value.Get<std::string>() : std::string("(not a string)");
}

double number_at(const tinygltf::Value& object, const char* key, double otherwise) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

glm::dvec2 vec2_at(const tinygltf::Value& object, const char* key, glm::dvec2 otherwise) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& array = object.Get(key);
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

glm::dvec3 vec3_from(const std::vector<double>& numbers, glm::dvec3 otherwise) {
    return numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : otherwise;
}

GltfAttributes attributes_from(const std::map<std::string, int>& attributes) {
    GltfAttributes result;
    for (const auto& [name, accessor] : attributes) result[name] = index_from(accessor);
    return result;
}

/// T · R · S of KHR_texture_transform. Texture coordinates run downwards, so that its
/// counter-clockwise rotation has the sines of a clockwise one.
glm::mat3 texture_matrix(const tinygltf::Value& transform) {
    const glm::dvec2 offset = vec2_at(transform, "offset", glm::dvec2(0.0));
    const glm::dvec2 scale = vec2_at(transform, "scale", glm::dvec2(1.0));
    const double rotation = number_at(transform, "rotation", 0.0);
    const double cosine = std::cos(rotation);
    const double sine = std::sin(rotation);
    return {glm::vec3(cosine * scale.x, -sine * scale.x, 0.0),
            glm::vec3(sine * scale.y, cosine * scale.y, 0.0), glm::vec3(offset, 1.0)};
}

TextureUse texture_use_from(const tinygltf::TextureInfo& info) {
    TextureUse use;
    use.texture = index_from(info.index);
    use.uv_set = static_cast<uint32_t>(info.texCoord);
    const auto* transform = find_extension(info.extensions, "KHR_texture_transform");
    if (transform == nullptr) return use;
    use.image_from_mesh = texture_matrix(*transform);
    if (transform->Has("texCoord")) {
        use.uv_set = static_cast<uint32_t>(transform->Get("texCoord").GetNumberAsInt());
    }
    return use;
}

GltfBufferView converted(const tinygltf::BufferView& view) {
    return {index_from(view.buffer), view.byteOffset, view.byteLength, view.byteStride};
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
    // tinygltf keeps these as int: what does not fit comes back as 4 billion and is out of range.
    result.sparse = {static_cast<uint32_t>(sparse.count),
                     index_from(sparse.indices.bufferView),
                     static_cast<uint32_t>(sparse.indices.byteOffset),
                     static_cast<uint32_t>(sparse.indices.componentType),
                     index_from(sparse.values.bufferView),
                     static_cast<uint32_t>(sparse.values.byteOffset)};
    return result;
}

GltfMesh converted(const tinygltf::Mesh& mesh) {
    GltfMesh result{mesh.name, {}};
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        result.primitives.push_back({attributes_from(primitive.attributes),
                                     index_from(primitive.indices), index_from(primitive.material),
                                     static_cast<uint32_t>(primitive.mode)});
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
    result.emission_texture = texture_use_from(material.emissiveTexture);
    return result;
}

GltfTexture converted(const tinygltf::Texture& texture) {
    return {texture.name, index_from(texture.source), index_from(texture.sampler)};
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
            string_extra(light.extras, "mode")};
}

GltfCamera converted(const tinygltf::Camera& camera) {
    const bool is_perspective = camera.type == "perspective";
    return {camera.name, is_perspective ? std::optional(camera.perspective.yfov) : std::nullopt};
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
    result.has_skin = node.skin >= 0;
    if (const auto* light = find_extension(node.extensions, "KHR_lights_punctual")) {
        result.light = index_from(light->Get("light").GetNumberAsInt());
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
    result.light_mode = string_extra(node.extras, "mode");
    result.is_probe_group = boolean_extra(node.extras, "light_probe_group").value_or(false);
    result.dering = boolean_extra(node.extras, "dering").value_or(false);
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
    document.sky_radiance = sky_radiance(model);
    return document;
}

Result<GltfDocument> parse_document(Bytes bytes, const std::string& path) {
    if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
        return Error{text(bytes.size(), " bytes are too many for a glTF file")};
    }
    const auto container = is_glb(bytes) ? GltfContainer::Glb : GltfContainer::Gltf;
    const auto json = container == GltfContainer::Glb ? glb_json(bytes) : Result<Bytes>(bytes);
    if (!json) return json.error();
    const std::string_view json_text(reinterpret_cast<const char*>(json->data()), json->size());
    const auto status = check_gltf_json(json_text, container);
    if (!status) return status.error();
    auto model = parse_model(bytes, folder_of(path));
    if (!model) return model.error();
    return document_from(std::move(*model), path);
}

}  // namespace

Result<GltfDocument> read_gltf_document(const std::string& path) {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    try {
        auto document = parse_document(*bytes, path);
        if (!document) return document.error().in(path);
        return document;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{text(path, ": cannot parse glTF (", exception.what(), ")")};
    }
}

std::string gltf_place(const char* kind, size_t index, const std::string& name) {
    return name.empty() ? text(kind, " ", index) : text(kind, " ", index, " \"", name, "\"");
}

}  // namespace tetralight::detail
