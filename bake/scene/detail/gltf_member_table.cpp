// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_member_table.h>

namespace tetralight::detail {
namespace {

constexpr std::string_view kAccessorNames[] = {
    "bufferView", "byteOffset", "componentType", "normalized", "count",
    "type",       "max",        "min",           "sparse",     "name"};
constexpr std::string_view kSparseNames[] = {"count", "indices", "values"};
constexpr std::string_view kSparseIndexNames[] = {"bufferView", "byteOffset", "componentType"};
constexpr std::string_view kSparseValueNames[] = {"bufferView", "byteOffset"};
constexpr std::string_view kAnimationNames[] = {"channels", "samplers", "name"};
constexpr std::string_view kChannelNames[] = {"sampler", "target"};
constexpr std::string_view kChannelTargetNames[] = {"node", "path"};
constexpr std::string_view kAnimationSamplerNames[] = {"input", "interpolation", "output"};
constexpr std::string_view kBufferNames[] = {"uri", "byteLength", "name"};
constexpr std::string_view kBufferViewNames[] = {"buffer",     "byteOffset", "byteLength",
                                                 "byteStride", "target",     "name"};
constexpr std::string_view kCameraNames[] = {"orthographic", "perspective", "type", "name"};
constexpr std::string_view kImageNames[] = {"uri", "mimeType", "bufferView", "name"};
constexpr std::string_view kMaterialNames[] = {"name",
                                               "pbrMetallicRoughness",
                                               "normalTexture",
                                               "occlusionTexture",
                                               "emissiveTexture",
                                               "emissiveFactor",
                                               "alphaMode",
                                               "alphaCutoff",
                                               "doubleSided"};
constexpr std::string_view kPbrMetallicRoughnessNames[] = {"baseColorFactor", "baseColorTexture",
                                                           "metallicFactor", "roughnessFactor",
                                                           "metallicRoughnessTexture"};
constexpr std::string_view kTextureInfoNames[] = {"index", "texCoord"};
constexpr std::string_view kNormalTextureNames[] = {"index", "texCoord", "scale"};
constexpr std::string_view kOcclusionTextureNames[] = {"index", "texCoord", "strength"};
constexpr std::string_view kEmissiveStrengthNames[] = {"emissiveStrength"};
constexpr std::string_view kSpecularGlossinessNames[] = {"diffuseFactor", "diffuseTexture",
                                                         "specularFactor", "glossinessFactor",
                                                         "specularGlossinessTexture"};
constexpr std::string_view kTransmissionNames[] = {"transmissionFactor", "transmissionTexture"};
constexpr std::string_view kTextureTransformNames[] = {"offset", "rotation", "scale", "texCoord"};
constexpr std::string_view kNodeVisibilityNames[] = {"visible"};
constexpr std::string_view kMeshNames[] = {"primitives", "weights", "name"};
constexpr std::string_view kPrimitiveNames[] = {"attributes", "indices", "material", "mode",
                                                "targets"};
constexpr std::string_view kNodeNames[] = {"camera",  "children", "skin",  "matrix",
                                           "mesh",    "rotation", "scale", "translation",
                                           "weights", "name"};
constexpr std::string_view kSamplerNames[] = {"magFilter", "minFilter", "wrapS", "wrapT", "name"};
constexpr std::string_view kSceneNames[] = {"nodes", "name"};
constexpr std::string_view kSkinNames[] = {"inverseBindMatrices", "skeleton", "joints", "name"};
constexpr std::string_view kTextureNames[] = {"sampler", "source", "name"};
constexpr std::string_view kLightNames[] = {"name", "color", "intensity", "type", "range", "spot"};
constexpr std::string_view kSpotNames[] = {"innerConeAngle", "outerConeAngle"};
constexpr std::string_view kAreaLightNames[] = {"name", "color", "intensity",
                                                "type", "size",  "rect"};
constexpr std::string_view kAreaRectNames[] = {"aspect"};
constexpr std::string_view kPerspectiveNames[] = {"aspectRatio", "yfov", "zfar", "znear"};
constexpr std::string_view kOrthographicNames[] = {"xmag", "ymag", "zfar", "znear"};
constexpr std::string_view kFileNames[] = {"extensionsUsed", "extensionsRequired",
                                           "accessors",      "animations",
                                           "asset",          "buffers",
                                           "bufferViews",    "cameras",
                                           "images",         "materials",
                                           "meshes",         "nodes",
                                           "samplers",       "scene",
                                           "scenes",         "skins",
                                           "textures"};
constexpr std::string_view kAssetNames[] = {"copyright", "generator", "version", "minVersion"};

constexpr GltfMembers kMemberTable[] = {
    {"accessors", "accessors", "", kAccessorNames},
    {"sparse", "accessors", "sparse", kSparseNames},
    {"sparse.indices", "accessors", "sparse/indices", kSparseIndexNames},
    {"sparse.values", "accessors", "sparse/values", kSparseValueNames},
    {"animations", "animations", "", kAnimationNames},
    {"channels of animations", "animations", "channels", kChannelNames},
    {"targets of channels", "animations", "channels/target", kChannelTargetNames},
    {"samplers of animations", "animations", "samplers", kAnimationSamplerNames},
    {"buffers", "buffers", "", kBufferNames},
    {"bufferViews", "bufferViews", "", kBufferViewNames},
    {"cameras", "cameras", "", kCameraNames},
    {"images", "images", "", kImageNames},
    {"materials", "materials", "", kMaterialNames},
    {"pbrMetallicRoughness", "materials", "pbrMetallicRoughness", kPbrMetallicRoughnessNames},
    {"baseColorTexture", "materials", "pbrMetallicRoughness/baseColorTexture", kTextureInfoNames},
    {"metallicRoughnessTexture", "materials", "pbrMetallicRoughness/metallicRoughnessTexture",
     kTextureInfoNames},
    {"emissiveTexture", "materials", "emissiveTexture", kTextureInfoNames},
    {"normalTexture", "materials", "normalTexture", kNormalTextureNames},
    {"occlusionTexture", "materials", "occlusionTexture", kOcclusionTextureNames},
    {"KHR_materials_emissive_strength", "materials", "extensions/KHR_materials_emissive_strength",
     kEmissiveStrengthNames},
    {"KHR_materials_pbrSpecularGlossiness", "materials",
     "extensions/KHR_materials_pbrSpecularGlossiness", kSpecularGlossinessNames},
    {"KHR_materials_transmission", "materials", "extensions/KHR_materials_transmission",
     kTransmissionNames},
    {"meshes", "meshes", "", kMeshNames},
    {"primitives", "meshes", "primitives", kPrimitiveNames},
    {"nodes", "nodes", "", kNodeNames},
    {"KHR_node_visibility", "nodes", "extensions/KHR_node_visibility", kNodeVisibilityNames},
    {"KHR_texture_transform", "materials",
     "pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform",
     kTextureTransformNames},
    {"KHR_texture_transform", "materials",
     "pbrMetallicRoughness/metallicRoughnessTexture/extensions/KHR_texture_transform",
     kTextureTransformNames},
    {"KHR_texture_transform", "materials", "emissiveTexture/extensions/KHR_texture_transform",
     kTextureTransformNames},
    {"KHR_texture_transform", "materials", "normalTexture/extensions/KHR_texture_transform",
     kTextureTransformNames},
    {"samplers", "samplers", "", kSamplerNames},
    {"scenes", "scenes", "", kSceneNames},
    {"skins", "skins", "", kSkinNames},
    {"textures", "textures", "", kTextureNames},
    {"lights", "lights", "", kLightNames},
    {"spot", "lights", "spot", kSpotNames},
    {"area lights", "area lights", "", kAreaLightNames},
    {"rect", "area lights", "rect", kAreaRectNames},
    {"perspective", "cameras", "perspective", kPerspectiveNames},
    {"orthographic", "cameras", "orthographic", kOrthographicNames},
    {"the file", "", "", kFileNames},
    {"asset", "", "asset", kAssetNames},
};

}  // namespace

std::span<const GltfMembers> gltf_member_table() {
    return kMemberTable;
}

}  // namespace tetralight::detail
