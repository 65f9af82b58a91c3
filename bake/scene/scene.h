// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/bake/scene/scene_memory.h>
#include <tetralight/bake/scene/scene_parts.h>
#include <tetralight/probes/light.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/probe_group.h>

// The input of a bake as plain values, from read_gltf() or made by the caller. Elements refer to
// each other by index. Coordinates are those of glTF: right-handed, Y up, metres.

namespace tetralight {

/// How a texture coordinate outside [0, 1] is read (glTF sampler wrap modes).
enum class TextureWrap : uint8_t { Repeat, MirroredRepeat, ClampToEdge };

/// A sampled image: bilinear filtering, glTF's wrap modes, row 0 at v = 0.
struct Texture {
    std::string name;
    Image8 image;
    TextureWrap wrap_u = TextureWrap::Repeat;
    TextureWrap wrap_v = TextureWrap::Repeat;

    bool operator==(const Texture&) const = default;
};

/// A texture as a material uses it.
struct TextureUse {
    uint32_t texture = kNoIndex;
    /// Which of a mesh's texture coordinate sets: 0 or 1.
    uint32_t uv_set = 0;
    /// KHR_texture_transform: image_uv = image_from_mesh · (u, v, 1).
    glm::mat3 image_from_mesh{1.0f};

    bool operator==(const TextureUse&) const = default;
};

enum class AlphaMode : uint8_t { Opaque, Mask, Blend };

/// glTF's metallic-roughness material, as far as diffuse light transport needs it.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};  ///< linear, times the texture's (sRGB-decoded) colour
    TextureUse base_color_texture;
    float metallic = 1.0f;
    float roughness = 1.0f;
    TextureUse metallic_roughness_texture;  ///< roughness × green, metallic × blue, both linear
    glm::vec3 emission{0.0f};  ///< radiance, linear, strength included, times the texture's colour
    TextureUse emission_texture;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool is_double_sided = false;
    /// KHR_materials_unlit: shows its base colour independent of light. In a bake the base colour
    /// is emission, and the material reflects nothing.
    bool is_unlit = false;
    /// True if a bake includes the material's emission (`extras.bake_emission`).
    bool bakes_emission = true;
    /// `texture` is an index into `Scene::normal_maps`.
    TextureUse normal_texture;
    float normal_scale = 1.0f;  ///< factor on x and y of the normal map's normals

    bool operator==(const Material&) const = default;
};

/// One primitive: indexed triangles with one material. Arrays beside `positions` are empty or as
/// long as it.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs[2];
    /// Linear, at least 0: times the material's base colour and alpha (COLOR_0).
    std::vector<glm::vec4> colors;
    /// xyz: the direction of u of the normal map; w: 1, or −1 if it is mirrored. Empty: tangents
    /// come from the UVs (bake/scene/mapped_normal.h).
    std::vector<glm::vec4> tangents;
    /// Three a triangle, counter-clockwise seen from the front.
    std::vector<uint32_t> indices;
    uint32_t material = kNoIndex;

    bool operator==(const Mesh&) const = default;
};

/// How a moving object takes its light from probes.
enum class LightProbeUsage : uint8_t {
    Off,          ///< no probes: the ambient light of the volume
    Blend,        ///< at one position: its anchor, else the centre of its bounds
    ProxyVolume,  ///< a grid around it (lppv/lppv.h)
};

/// A node of the glTF hierarchy, in the default scene.
struct SceneNode {
    std::string name;
    uint32_t parent = kNoIndex;
    glm::dmat4 world_from_node{1.0};
    /// `extras.light_probes`, inherited.
    LightProbeUsage light_probes = LightProbeUsage::Blend;
    /// `extras.probe_anchor`, inherited: the node at whose origin moving objects take their light,
    /// or kNoIndex.
    uint32_t probe_anchor = kNoIndex;

    bool operator==(const SceneNode&) const = default;
};

/// Where a static object takes the light from that it receives.
enum class ReceiveGi : uint8_t { Lightmap, Probes };

/// How a static object uses lightmaps.
struct LightmapUse {
    /// `extras.receive_gi`. Objects with `Probes` still reflect and block light.
    ReceiveGi receive_gi = ReceiveGi::Lightmap;
    /// Factor on the texels per metre (`extras.lightmap_scale`), at least 0. 0: no lightmap.
    float scale = 1.0f;
    /// True if the seams between its charts are made to match (`extras.stitch_seams`).
    bool stitches_seams = true;

    bool operator==(const LightmapUse&) const = default;
};

/// A mesh placed in the world.
struct MeshInstance {
    uint32_t mesh = 0;
    glm::dmat4 world_from_mesh{1.0};
    /// Name of the glTF node, for messages and for finding objects.
    std::string name;
    /// False for moving objects, which a bake ignores (`extras.contribute_gi: false`).
    bool contributes_gi = true;
    /// The node of the instance, or kNoIndex.
    uint32_t node = kNoIndex;
    /// True if things move on it (`extras.walkable: true`). Its other roles do not change.
    bool is_walkable = false;
    /// False: the cubes of reflection probes do not show it (`extras.in_reflections: false`). It
    /// still lights what they show.
    bool is_in_reflections = true;
    LightmapUse lightmap{};

    bool operator==(const MeshInstance&) const = default;
};

/// Distant light from all directions.
struct Environment {
    /// Radiance of every direction; a factor on the image if there is one.
    glm::vec3 radiance{0.0f};
    /// Equirectangular; empty = constant. Centre = +X, +Z to its right, +Y up, before the rotation.
    ImageF image;
    /// Rotation of the image about +Y, counter-clockwise seen from above.
    float rotation_radians = 0.0f;

    bool operator==(const Environment&) const = default;
};

/// A camera: it looks along its −Z, with +Y up in the picture.
struct Camera {
    std::string name;
    glm::dmat4 world_from_camera{1.0};
    /// Vertical field of view of a perspective camera.
    double fov_y_radians = 0.8;
    /// Half the height of the picture of an orthographic camera, metres, above 0. Empty for a
    /// perspective camera.
    std::optional<double> half_height = std::nullopt;

    bool operator==(const Camera&) const = default;
};

/// A rectangle through which light enters a room, such as a window (`extras.portal`). It is no
/// surface: it tells a bake where to look for light.
struct Portal {
    std::string name;
    /// Position of its centre; edges, perpendicular to each other.
    glm::dvec3 center{0.0};
    glm::dvec3 along{0.0}, across{0.0};

    bool operator==(const Portal&) const = default;
};

/// Which scene of a file was read, in which pose and in which unit; defaults are the file's own.
struct SceneChoice {
    std::string scene_name;
    std::optional<double> time_seconds;
    std::string animation;
    /// Intensities of lights were divided by 683.
    bool is_in_watts = false;

    bool operator==(const SceneChoice&) const = default;
};

struct Scene {
    std::vector<Texture> textures;
    /// Textures of normal maps, apart from the others: bakes of probes do not depend on them.
    std::vector<Texture> normal_maps;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<MeshInstance> instances;
    /// Parents before their children.
    std::vector<SceneNode> nodes;
    std::vector<Light> lights;
    /// Names of `lights`, in the same order.
    std::vector<std::string> light_names;
    Environment environment;
    std::vector<Camera> cameras;
    std::vector<ProbeGroup> probe_groups;
    std::vector<ProbeAdjustment> probe_adjustments;
    std::vector<Portal> portals;
    std::vector<ReflectionPlace> reflection_places;
    /// What was read of the file, and what was not.
    std::vector<ScenePart> parts;
    /// What reading it took.
    SceneMemory memory;
    /// What was asked for when it was read: its scene and pose.
    SceneChoice choice;
    /// Warnings for the user, one line each: parts that were skipped or replaced.
    std::vector<std::string> warnings;

    bool operator==(const Scene&) const = default;
};

}  // namespace tetralight
