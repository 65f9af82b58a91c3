// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_schema.h>

#include <algorithm>

namespace tetralight::detail {
namespace {

using enum GltfKind;
constexpr GltfNeed kRequired = GltfNeed::Required, kInObject = GltfNeed::InObject;

constexpr GltfRule kScenes[] = {
    {"name", String},
    {"nodes", IndexList, "nodes"},
    {"extensions/EXT_lights_image_based/light", Index, "image-based lights", 0, kRequired},
    {"extras/sky/radiance", Numbers, "", 3, kRequired},
};

constexpr GltfRule kNodes[] = {
    {"name", String},
    {"children", IndexList, "nodes"},
    {"mesh", Index, "meshes"},
    {"camera", Index, "cameras"},
    {"skin", Index, "skins"},
    {"weights", Numbers},
    {"matrix", Numbers, "", 16},
    {"translation", Numbers, "", 3},
    {"rotation", Numbers, "", 4},
    {"scale", Numbers, "", 3},
    {"extensions/KHR_lights_punctual/light", Index, "lights", 0, kRequired},
    {"extensions/EXT_lights_area/light", Index, "area lights", 0, kRequired},
    {"extensions/KHR_node_visibility/visible", Boolean},
    {"extensions/EXT_mesh_gpu_instancing/attributes", IndexMap, "accessors", 0, kRequired},
    {"extras/contribute_gi", BooleanOrBit},
    {"extras/walkable", BooleanOrBit},
    {"extras/in_reflections", BooleanOrBit},
    {"extras/lightmap_scale", Number},
    {"extras/stitch_seams", BooleanOrBit},
    {"extras/light_probe_group", BooleanOrBit},
    {"extras/probe_resolution", Numbers, "", 3},
    {"extras/dering", BooleanOrBit},
    {"extras/rendering_layers", RenderingLayers},
    {"extras/portal", Numbers, "", 2},
    {"extras/probe_adjustment/shape", String, "", 0, kRequired},
    {"extras/probe_adjustment/size", Numbers, "", 3},
    {"extras/probe_adjustment/radius", Number},
    {"extras/probe_adjustment/forbid", BooleanOrBit},
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

constexpr GltfRule kMeshes[] = {
    {"name", String},
    {"primitives", Parts, "primitives", 0, kRequired},
    {"weights", Numbers},
};

constexpr GltfRule kPrimitives[] = {
    {"attributes", IndexMap, "accessors", 0, kRequired},
    {"indices", Index, "accessors"},
    {"material", Index, "materials"},
    {"mode", Size},
    {"targets", IndexMapList, "accessors"},
    {"extensions/KHR_draco_mesh_compression/bufferView", Index, "bufferViews", 0, kRequired},
    {"extensions/KHR_draco_mesh_compression/attributes", SizeMap, "", 0, kRequired},
};

constexpr GltfRule kAccessors[] = {
    {"bufferView", Index, "bufferViews"},
    {"byteOffset", Size},
    {"componentType", Size, "", 0, kRequired},
    {"normalized", Boolean},
    {"count", Size, "", 0, kRequired},
    {"type", String, "", 0, kRequired},
    {"sparse/count", Size, "", 0, kRequired},
    {"sparse/indices", Object, "", 0, kRequired},
    {"sparse/indices/bufferView", Index, "bufferViews", 0, kRequired},
    {"sparse/indices/byteOffset", Size},
    {"sparse/indices/componentType", Size, "", 0, kRequired},
    {"sparse/values", Object, "", 0, kRequired},
    {"sparse/values/bufferView", Index, "bufferViews", 0, kRequired},
    {"sparse/values/byteOffset", Size},
};

constexpr GltfRule kBufferViews[] = {
    {"buffer", Index, "buffers", 0, kRequired},
    {"byteOffset", Size},
    {"byteLength", Size, "", 0, kRequired},
    {"byteStride", Size},
    {"extensions/EXT_meshopt_compression/buffer", Index, "buffers", 0, kRequired},
    {"extensions/EXT_meshopt_compression/byteOffset", Size},
    {"extensions/EXT_meshopt_compression/byteLength", Size, "", 0, kRequired},
    {"extensions/EXT_meshopt_compression/byteStride", Size, "", 0, kRequired},
    {"extensions/EXT_meshopt_compression/count", Size, "", 0, kRequired},
    {"extensions/EXT_meshopt_compression/mode", String, "", 0, kRequired},
    {"extensions/EXT_meshopt_compression/filter", String},
};

constexpr GltfRule kBuffers[] = {
    {"uri", String},
    {"byteLength", Size, "", 0, kRequired},
    {"extensions/EXT_meshopt_compression/fallback", Boolean},
};

constexpr GltfRule kTextureInfo[] = {
    {"index", Index, "textures", 0, kRequired},
    {"texCoord", Size},
    {"scale", Number},
    {"extensions/KHR_texture_transform/offset", Numbers, "", 2},
    {"extensions/KHR_texture_transform/scale", Numbers, "", 2},
    {"extensions/KHR_texture_transform/rotation", Number},
    {"extensions/KHR_texture_transform/texCoord", Size},
};

constexpr GltfRule kMaterials[] = {
    {"name", String},
    {"pbrMetallicRoughness/baseColorFactor", Numbers, "", 4},
    {"pbrMetallicRoughness/metallicFactor", Number},
    {"pbrMetallicRoughness/roughnessFactor", Number},
    {"pbrMetallicRoughness/baseColorTexture", Part, "texture"},
    {"pbrMetallicRoughness/metallicRoughnessTexture", Part, "texture"},
    {"emissiveFactor", Numbers, "", 3},
    {"emissiveTexture", Part, "texture"},
    {"normalTexture", Part, "texture"},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", Number},
    {"extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", Numbers, "", 4},
    {"extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", Numbers, "", 3},
    {"extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", Number},
    {"extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture", Part, "texture"},
    {"extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture", Part, "texture"},
    {"extensions/KHR_materials_transmission/transmissionFactor", Number},
    {"extensions/KHR_materials_transmission/transmissionTexture", Part, "texture"},
    {"alphaMode", String},
    {"alphaCutoff", Number},
    {"doubleSided", Boolean},
};

constexpr GltfRule kTextures[] = {
    {"source", Index, "images"},
    {"sampler", Index, "samplers"},
    {"extensions/EXT_texture_webp/source", Index, "images"},
    {"extensions/KHR_texture_basisu/source", Index, "images"},
};

constexpr GltfRule kImages[] = {
    {"name", String},
    {"uri", String},
    {"bufferView", Index, "bufferViews"},
};

constexpr GltfRule kSamplers[] = {{"wrapS", Size}, {"wrapT", Size}};

constexpr GltfRule kSkins[] = {
    {"name", String},
    {"joints", IndexList, "nodes", 0, kRequired},
    {"inverseBindMatrices", Index, "accessors"},
};

constexpr GltfRule kAnimations[] = {
    {"name", String},
    {"samplers", Parts, "samplers of animations", 0, kRequired},
    {"channels", Parts, "channels", 0, kRequired},
};

constexpr GltfRule kChannels[] = {
    {"sampler", Size, "", 0, kRequired},
    {"target", Object, "", 0, kRequired},
    {"target/node", Index, "nodes"},
    {"target/path", String, "", 0, kRequired},
};

constexpr GltfRule kAnimationSamplers[] = {
    {"input", Index, "accessors", 0, kRequired},
    {"output", Index, "accessors", 0, kRequired},
    {"interpolation", String},
};

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

constexpr GltfRule kAreaLights[] = {
    {"name", String},
    {"type", String, "", 0, kRequired},
    {"color", Numbers, "", 3},
    {"intensity", Number},
    {"size", Number},
    {"rect", Object},
    {"rect/aspect", Number},
    {"extras/mode", String},
    {"extras/falloff", String},
    {"extras/shape", String},
    {"extras/indirect_multiplier", Number},
    {"extras/radius", Number},
    {"extras/angle", Number},
    {"extras/width", Number},
    {"extras/height", Number},
};

constexpr GltfRule kImageBasedLights[] = {
    {"name", String},
    {"rotation", Numbers, "", 4},
    {"intensity", Number},
    {"irradianceCoefficients", NumbersList, "", 3},
    {"specularImages", IndexLists, "images", 6},
    {"specularImageSize", Size},
    {"extras/sky", BooleanOrBit},
};

constexpr GltfRule kCameras[] = {
    {"name", String},
    {"type", String, "", 0, kRequired},
    {"perspective/yfov", Number, "", 0, kRequired},
    {"orthographic/ymag", Number, "", 0, kRequired},
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
    {"skins", "skins", "skin", kSkins},
    {"animations", "animations", "animation", kAnimations},
    {"lights", "extensions/KHR_lights_punctual/lights", "light", kLights},
    {"area lights", "extensions/EXT_lights_area/lights", "area light", kAreaLights},
    {"image-based lights", "extensions/EXT_lights_image_based/lights", "image-based light",
     kImageBasedLights},
    {"cameras", "cameras", "camera", kCameras},
    {"nodes", "nodes", "node", kNodes},
    {"scenes", "scenes", "scene", kScenes},
};

constexpr GltfPart kParts[] = {
    {"texture", "texture", kTextureInfo},
    {"primitives", "primitive", kPrimitives},
    {"channels", "channel", kChannels},
    {"samplers of animations", "sampler", kAnimationSamplers},
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

const GltfPart& gltf_part(std::string_view name) {
    return *std::ranges::find(kParts, name, &GltfPart::name);
}

}  // namespace tetralight::detail
