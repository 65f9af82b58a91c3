// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_schema.h>

#include <algorithm>

namespace tetralight::detail {
namespace {

using enum GltfKind;
constexpr GltfNeed kRequired = GltfNeed::Required, kInObject = GltfNeed::InObject;

constexpr GltfRule kScenes[] = {
    {"nodes", IndexList, "nodes"},
    {"extras/sky/radiance", Numbers, "", 3, kRequired},
};

constexpr GltfRule kNodes[] = {
    {"name", String},
    {"children", IndexList, "nodes"},
    {"mesh", Index, "meshes"},
    {"camera", Index, "cameras"},
    {"skin", Index, "skins"},
    {"matrix", Numbers, "", 16},
    {"translation", Numbers, "", 3},
    {"rotation", Numbers, "", 4},
    {"scale", Numbers, "", 3},
    {"extensions/KHR_lights_punctual/light", Index, "lights", 0, kRequired},
    {"extensions/EXT_mesh_gpu_instancing/attributes", IndexMap, "accessors", 0, kRequired},
    {"extras/contribute_gi", Boolean},
    {"extras/walkable", Boolean},
    {"extras/in_reflections", Boolean},
    {"extras/lightmap_scale", Number},
    {"extras/stitch_seams", Boolean},
    {"extras/light_probe_group", Boolean},
    {"extras/dering", Boolean},
    {"extras/rendering_layers", RenderingLayers},
    {"extras/portal", Numbers, "", 2},
    {"extras/probe_adjustment/shape", String, "", 0, kRequired},
    {"extras/probe_adjustment/size", Numbers, "", 3},
    {"extras/probe_adjustment/radius", Number},
    {"extras/probe_adjustment/forbid", Boolean},
    {"extras/probe_adjustment/spacing", Number},
    {"extras/probe_adjustment/validity", Number},
    {"extras/probe_adjustment/intensity", Number},
    {"extras/probe_adjustment/rendering_layers", RenderingLayers},
    {"extras/reflection_probe", ObjectOrBoolean},
    {"extras/reflection_probe/size", Numbers, "", 3, kInObject},
    {"extras/reflection_probe/center", Numbers, "", 3, kInObject},
    {"extras/reflection_probe/blend_distance", Number, "", 0, kInObject},
    {"extras/reflection_probe/importance", Integer, "", 0, kInObject},
    {"extras/reflection_probe/near", Number, "", 0, kInObject},
};

constexpr GltfRule kMeshes[] = {{"name", String}, {"primitives", PrimitiveList, "", 0, kRequired}};

constexpr GltfRule kPrimitives[] = {
    {"attributes", IndexMap, "accessors", 0, kRequired},
    {"indices", Index, "accessors"},
    {"material", Index, "materials"},
    {"mode", Size},
};

constexpr GltfRule kAccessors[] = {
    {"bufferView", Index, "bufferViews"},
    {"byteOffset", Size},
    {"componentType", Size, "", 0, kRequired},
    {"normalized", Boolean},
    {"count", Size, "", 0, kRequired},
    {"type", String, "", 0, kRequired},
    {"sparse/count", Size, "", 0, kRequired},
    {"sparse/indices/bufferView", Index, "bufferViews", 0, kRequired},
    {"sparse/indices/byteOffset", Size},
    {"sparse/indices/componentType", Size, "", 0, kRequired},
    {"sparse/values/bufferView", Index, "bufferViews", 0, kRequired},
    {"sparse/values/byteOffset", Size},
};

constexpr GltfRule kBufferViews[] = {
    {"buffer", Index, "buffers", 0, kRequired},
    {"byteOffset", Size},
    {"byteLength", Size, "", 0, kRequired},
    {"byteStride", Size},
};

constexpr GltfRule kBuffers[] = {{"uri", String}, {"byteLength", Size, "", 0, kRequired}};

constexpr GltfRule kMaterials[] = {
    {"name", String},
    {"pbrMetallicRoughness/baseColorFactor", Numbers, "", 4},
    {"pbrMetallicRoughness/metallicFactor", Number},
    {"pbrMetallicRoughness/roughnessFactor", Number},
    {"pbrMetallicRoughness/baseColorTexture/index", Index, "textures", 0, kRequired},
    {"pbrMetallicRoughness/baseColorTexture/texCoord", Size},
    {"pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", Numbers, "",
     2},
    {"pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale", Numbers, "",
     2},
    {"pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation", Number},
    {"pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/texCoord", Size},
    {"pbrMetallicRoughness/metallicRoughnessTexture/index", Index, "textures", 0, kRequired},
    {"pbrMetallicRoughness/metallicRoughnessTexture/texCoord", Size},
    {"pbrMetallicRoughness/metallicRoughnessTexture/extensions/KHR_texture_transform/offset",
     Numbers, "", 2},
    {"pbrMetallicRoughness/metallicRoughnessTexture/extensions/KHR_texture_transform/scale",
     Numbers, "", 2},
    {"pbrMetallicRoughness/metallicRoughnessTexture/extensions/KHR_texture_transform/rotation",
     Number},
    {"pbrMetallicRoughness/metallicRoughnessTexture/extensions/KHR_texture_transform/texCoord",
     Size},
    {"emissiveFactor", Numbers, "", 3},
    {"emissiveTexture/index", Index, "textures", 0, kRequired},
    {"emissiveTexture/texCoord", Size},
    {"emissiveTexture/extensions/KHR_texture_transform/offset", Numbers, "", 2},
    {"emissiveTexture/extensions/KHR_texture_transform/scale", Numbers, "", 2},
    {"emissiveTexture/extensions/KHR_texture_transform/rotation", Number},
    {"emissiveTexture/extensions/KHR_texture_transform/texCoord", Size},
    {"normalTexture/index", Index, "textures", 0, kRequired},
    {"normalTexture/texCoord", Size},
    {"normalTexture/scale", Number},
    {"normalTexture/extensions/KHR_texture_transform/offset", Numbers, "", 2},
    {"normalTexture/extensions/KHR_texture_transform/scale", Numbers, "", 2},
    {"normalTexture/extensions/KHR_texture_transform/rotation", Number},
    {"normalTexture/extensions/KHR_texture_transform/texCoord", Size},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", Number},
    {"alphaMode", String},
    {"alphaCutoff", Number},
    {"doubleSided", Boolean},
};

constexpr GltfRule kTextures[] = {{"source", Index, "images"}, {"sampler", Index, "samplers"}};

constexpr GltfRule kImages[] = {
    {"name", String},
    {"uri", String},
    {"bufferView", Index, "bufferViews"},
};

constexpr GltfRule kSamplers[] = {{"wrapS", Size}, {"wrapT", Size}};

constexpr GltfRule kLights[] = {
    {"name", String},
    {"type", String, "", 0, kRequired},
    {"color", Numbers, "", 3},
    {"intensity", Number},
    {"range", Number},
    {"spot", Object},
    {"spot/innerConeAngle", Number},
    {"spot/outerConeAngle", Number},
    {"extras/mode", String},
    {"extras/falloff", String},
    {"extras/shape", String},
    {"extras/indirect_multiplier", Number},
    {"extras/radius", Number},
    {"extras/angle", Number},
    {"extras/width", Number},
    {"extras/height", Number},
};

constexpr GltfRule kCameras[] = {
    {"name", String},
    {"type", String, "", 0, kRequired},
    {"perspective/yfov", Number, "", 0, kRequired},
};

constexpr GltfSection kSections[] = {
    {"buffers", "buffers", "buffer", kBuffers},
    {"bufferViews", "bufferViews", "buffer view", kBufferViews},
    {"accessors", "accessors", "accessor", kAccessors},
    {"images", "images", "image", kImages},
    {"samplers", "samplers", "sampler", kSamplers},
    {"textures", "textures", "texture", kTextures},
    {"materials", "materials", "material", kMaterials},
    {"meshes", "meshes", "mesh", kMeshes},
    {"skins", "skins", "skin", {}},
    {"lights", "extensions/KHR_lights_punctual/lights", "light", kLights},
    {"cameras", "cameras", "camera", kCameras},
    {"nodes", "nodes", "node", kNodes},
    {"scenes", "scenes", "scene", kScenes},
};

}  // namespace

std::span<const GltfSection> gltf_sections() {
    return kSections;
}

std::string member_path(std::string_view path) {
    std::string members(path);
    std::ranges::replace(members, '/', '.');
    return members;
}

std::span<const GltfRule> gltf_primitive_rules() {
    return kPrimitives;
}

}  // namespace tetralight::detail
