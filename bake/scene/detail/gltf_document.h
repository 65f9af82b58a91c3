// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

// The contents of a glTF file as plain values, before they are interpreted. Indices are in range,
// or kNoIndex if the file leaves them out; numbers are finite; buffer views lie in their buffers.

namespace tetralight::detail {

/// EXT_meshopt_compression of a buffer view: where its compressed bytes are.
struct GltfMeshopt {
    uint32_t buffer = 0;
    uint64_t byte_offset = 0;
    uint64_t byte_length = 0;
    /// Bytes of an element, and their number.
    uint64_t byte_stride = 0;
    uint64_t count = 0;
    std::string mode;
    std::string filter = "NONE";
};

struct GltfBufferView {
    uint32_t buffer = 0;
    uint64_t byte_offset = 0;
    uint64_t byte_length = 0;
    /// 0 = tightly packed.
    uint64_t byte_stride = 0;
    std::optional<GltfMeshopt> meshopt;
};

/// Elements that replace some of an accessor's.
struct GltfSparse {
    uint64_t count = 0;
    uint32_t index_view = 0;
    uint64_t index_byte_offset = 0;
    uint32_t index_component_type = 0;
    uint32_t value_view = 0;
    uint64_t value_byte_offset = 0;
};

struct GltfAccessor {
    /// kNoIndex = zeros.
    uint32_t buffer_view = kNoIndex;
    uint64_t byte_offset = 0;
    /// glTF's code, 5120 (byte) to 5126 (float).
    uint32_t component_type = 0;
    /// 1 to 4; 16 for MAT4; 0 for other matrices, which are not read.
    uint32_t component_count = 0;
    bool is_normalized = false;
    uint64_t count = 0;
    std::optional<GltfSparse> sparse;
};

/// Accessors by the name of their attribute: `POSITION`, `TEXCOORD_0`, `TRANSLATION`.
using GltfAttributes = std::map<std::string, uint32_t>;

/// KHR_draco_mesh_compression of a primitive.
struct GltfDraco {
    uint32_t buffer_view = 0;
    /// The id in the compressed data of each attribute.
    std::map<std::string, uint32_t> attributes;
};

struct GltfPrimitive {
    GltfAttributes attributes;
    uint32_t indices = kNoIndex;
    uint32_t material = kNoIndex;
    /// glTF's code: 0 = points, 4 = triangles, 5 = strip, 6 = fan.
    uint32_t mode = 4;
    /// Differences of POSITION, NORMAL and TANGENT, one map a morph target.
    std::vector<GltfAttributes> targets;
    std::optional<GltfDraco> draco;
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
    /// Default weights of the morph targets; empty: 0.
    std::vector<double> weights;
};

struct GltfSkin {
    std::string name;
    /// Nodes.
    std::vector<uint32_t> joints;
    /// Accessor of a matrix for each joint; kNoIndex = unit matrices.
    uint32_t inverse_bind_matrices = kNoIndex;
};

/// What an animation changes over time: a property of a node.
struct GltfChannel {
    /// kNoIndex: the target is not a node's (KHR_animation_pointer).
    uint32_t node = kNoIndex;
    /// "translation", "rotation", "scale" or "weights".
    std::string path;
    /// Accessors of the times, seconds, and of the values.
    uint32_t input = 0;
    uint32_t output = 0;
    /// "LINEAR", "STEP" or "CUBICSPLINE".
    std::string interpolation = "LINEAR";
};

struct GltfAnimation {
    std::string name;
    std::vector<GltfChannel> channels;
};

/// KHR_materials_pbrSpecularGlossiness.
struct GltfSpecularGlossiness {
    glm::dvec4 diffuse{1.0};
    glm::dvec3 specular{1.0};
    double glossiness = 1.0;
    TextureUse diffuse_texture;
    /// RGB: specular, sRGB; alpha: glossiness.
    TextureUse specular_glossiness_texture;
};

/// KHR_materials_transmission.
struct GltfTransmission {
    double factor = 0.0;
    TextureUse texture;  ///< times red
};

struct GltfMaterial {
    std::string name;
    glm::dvec4 base_color{1.0};
    double metallic = 1.0;
    double roughness = 1.0;
    glm::dvec3 emissive_factor{0.0};
    double emissive_strength = 1.0;
    std::string alpha_mode;
    double alpha_cutoff = 0.5;
    bool is_double_sided = false;
    /// KHR_materials_unlit.
    bool is_unlit = false;
    /// From extras; true reads "baked", false "none".
    std::optional<std::string> bake_emission;
    /// `texture` is an index of GltfDocument::textures here.
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;
    TextureUse emission_texture;
    TextureUse normal_texture;
    double normal_scale = 1.0;
    std::optional<GltfSpecularGlossiness> specular_glossiness;
    std::optional<GltfTransmission> transmission;
};

struct GltfTexture {
    std::string name;
    /// PNG or JPEG, or WebP of EXT_texture_webp where there is no other.
    uint32_t image = kNoIndex;
    uint32_t sampler = kNoIndex;
    /// KTX2 of KHR_texture_basisu, which is not read.
    uint32_t basisu_image = kNoIndex;
};

/// An encoded image: in a buffer view, in `encoded` (from a data URI), or in the file `uri`.
struct GltfImage {
    std::string name;
    std::string uri;
    uint32_t buffer_view = kNoIndex;
    std::vector<std::byte> encoded;
};

struct GltfSampler {
    uint32_t wrap_s = 0;
    uint32_t wrap_t = 0;
};

/// Extras of a light, or of its node, which take precedence. A value that should be a string and is
/// not becomes "(not a string)"; one that should be a number and is not becomes NaN.
struct GltfLightExtras {
    std::optional<std::string> mode;
    std::optional<std::string> falloff;
    std::optional<std::string> shape;
    std::optional<double> indirect_multiplier;
    std::optional<double> radius;
    std::optional<double> angle_degrees;
    std::optional<double> width;
    std::optional<double> height;
};

struct GltfLight {
    std::string name;
    std::string type;
    glm::dvec3 color{1.0};
    double intensity = 1.0;
    /// 0 = infinite.
    double range = 0.0;
    double inner_cone_radians = 0.0;
    double outer_cone_radians = 0.0;
    GltfLightExtras extras;
};

/// EXT_lights_area.
struct GltfAreaLight {
    std::string name;
    /// "rect" or "disk".
    std::string type;
    glm::dvec3 color{1.0};
    /// Luminance, cd/m²; empty: that of the extension.
    std::optional<double> intensity;
    /// Height of a rectangle, diameter of a disc, in metres at a scale of 1.
    double size = 1.0;
    /// Width of a rectangle over its height.
    double aspect = 1.0;
    GltfLightExtras extras;
};

struct GltfCamera {
    std::string name;
    /// Empty if the camera is not a perspective one.
    std::optional<double> fov_y_radians;
    /// `ymag`, above 0. Empty if the camera is not an orthographic one.
    std::optional<double> half_height;
};

/// EXT_lights_image_based.
struct GltfImageBasedLight {
    std::string name;
    /// Which of the document's image-based lights it is.
    uint32_t index = 0;
    /// From extras. False: the light is that of a place in the scene, and not its sky.
    bool is_sky = true;
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double intensity = 1.0;
    /// RGB of the 9 coefficients of irradiance.
    std::vector<glm::dvec3> irradiance_coefficients;
    uint32_t image_size = 0;
    /// Images of the faces +X, −X, +Y, −Y, +Z, −Z of each level.
    std::vector<std::array<uint32_t, 6>> images;
};

/// `extras.probe_adjustment` of a node.
struct GltfAdjustment {
    std::string shape;
    std::optional<glm::dvec3> size;
    std::optional<double> radius;
    std::optional<bool> forbid;
    std::optional<double> spacing;
    std::optional<double> validity;
    std::optional<double> intensity;
    std::optional<uint32_t> rendering_layers;
};

/// `extras.reflection_probe` of a node.
struct GltfReflectionProbe {
    glm::dvec3 size{10.0};
    glm::dvec3 center{0.0};
    double blend_distance = 0.25;
    int32_t importance = 1;
    double near_distance = 0.0;
};

struct GltfNode {
    std::string name;
    glm::dmat4 parent_from_node{1.0};
    /// The parts of `parent_from_node`, which animations change. Not those of a node with a matrix.
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::vector<uint32_t> children;
    uint32_t mesh = kNoIndex;
    uint32_t light = kNoIndex;
    uint32_t area_light = kNoIndex;
    uint32_t camera = kNoIndex;
    uint32_t skin = kNoIndex;
    /// Weights of the morph targets, before those of the mesh; empty: those of the mesh.
    std::vector<double> weights;
    /// KHR_node_visibility. A node that is not visible hides its children.
    bool is_visible = true;
    /// EXT_mesh_gpu_instancing.
    std::optional<GltfAttributes> instancing;
    // Extras that Tetralight defines.
    std::optional<bool> contributes_gi;
    std::optional<bool> is_walkable;
    std::optional<bool> is_in_reflections;
    std::optional<std::string> receive_gi;
    std::optional<double> lightmap_scale;
    std::optional<bool> stitches_seams;
    std::optional<std::string> light_probes;
    std::optional<std::string> probe_anchor;
    GltfLightExtras light_extras;
    bool is_probe_group = false;
    /// The probes of a box along each axis of the node: `extras.probe_resolution`.
    std::optional<glm::dvec3> probe_resolution;
    bool dering = false;
    std::optional<uint32_t> rendering_layers;
    std::optional<GltfAdjustment> probe_adjustment;
    std::optional<GltfReflectionProbe> reflection_probe;
    /// Width and height of `extras.portal`.
    std::optional<glm::dvec2> portal;
};

struct GltfDocument {
    /// The file's path. URIs are relative to its folder, and messages begin with it.
    std::string path;
    /// The program that wrote the file, as it calls itself: `asset.generator`.
    std::string generator;
    std::vector<std::vector<std::byte>> buffers;
    std::vector<GltfBufferView> buffer_views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfMesh> meshes;
    std::vector<GltfMaterial> materials;
    std::vector<GltfTexture> textures;
    std::vector<GltfImage> images;
    std::vector<GltfSampler> samplers;
    std::vector<GltfLight> lights;
    std::vector<GltfAreaLight> area_lights;
    std::vector<GltfCamera> cameras;
    std::vector<GltfSkin> skins;
    std::vector<GltfAnimation> animations;
    std::vector<GltfNode> nodes;
    /// KHR_mesh_quantization: texture coordinates may be integers that are not normalized.
    bool is_quantized = false;
    /// Roots of the scene that is read. Empty if there is no scene.
    std::optional<std::vector<uint32_t>> scene_roots;
    /// Index of that scene.
    uint32_t scene = 0;
    /// Radiance of the sky, from the scene's `extras.sky`.
    std::optional<glm::dvec3> sky_radiance;
    /// EXT_lights_image_based of the scene.
    std::optional<GltfImageBasedLight> image_based_light;
    /// What is in the file and is not read, or not as glTF defines it.
    std::vector<ScenePart> parts;
    /// What reading takes, without the images.
    SceneMemory memory;
    /// The animation that the nodes stand in; empty: none.
    std::optional<uint32_t> animation;
    /// Without the path.
    std::vector<std::string> warnings;
};

/// Reads and checks a .gltf or .glb file and its buffers, but not its image files. The scene that
/// is read is the one that `scene` names or whose index it is; empty: the default one. Returns
/// invalid_argument if there is no such scene, and out_of_resources, before anything is decoded, if
/// there is not enough memory.
[[nodiscard]] Result<GltfDocument> read_gltf_document(const std::string& path,
                                                      const std::string& scene = "");

/// How messages name an element: `mesh 3 "wall"`, or `mesh 3` if it has no name.
[[nodiscard]] std::string gltf_place(const char* kind, size_t index, const std::string& name);

/// The same error in an element of a section (gltf_schema.h): `node 3 "lamp": ` before the message,
/// and `nodes[3]` before a relative field.
[[nodiscard]] Error in_element(const Error& error, std::string_view section, size_t index,
                               const std::string& name);

}  // namespace tetralight::detail
