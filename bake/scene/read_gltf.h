// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Whether a reader reads normal maps and tangents. Most bakes do not use them.
enum class NormalMaps : bool { Skip, Read };

/// What the intensities of lights are in.
enum class LightUnit : uint8_t {
    Lux,   ///< as glTF says, lux and candela: read as they are, as radiance is
    Watt,  ///< the file has 683 times W/m² and W/sr, as Blender's "Standard" mode writes them
};

/// Lumens of a watt of green light, which exporters write instead of 1 (SI: luminous efficacy).
inline constexpr double kLumensPerWatt = 683.0;

/// What of a file is read, and how.
struct SceneReading {
    NormalMaps normal_maps = NormalMaps::Skip;
    /// The name of a scene of the file, or its index; empty: the default scene.
    std::string scene{};
    /// Seconds: nodes, morph targets and skins stand as the animation has them then. Empty: as
    /// they stand without an animation.
    std::optional<double> time{};
    /// The name of the animation, or its index; empty: the first one.
    std::string animation{};
    LightUnit light_unit = LightUnit::Lux;
    /// True if the caller adds a sky of its own. Only warnings depend on it.
    bool has_other_sky = false;
};

/// Reads a glTF 2.0 scene (.gltf or .glb): its default scene's node hierarchy flattened into
/// instances.
///
/// Read: indexed and non-indexed triangles, strips and fans; base colour and emission with textures
/// (KHR_texture_transform, KHR_materials_emissive_strength); normal maps and tangents if asked for;
/// KHR_lights_punctual; EXT_lights_area; EXT_lights_image_based of the scene, as its sky;
/// EXT_mesh_gpu_instancing; KHR_mesh_quantization; `extras.contribute_gi`, `extras.portal` and
/// `extras.reflection_probe` of a node; `extras.walkable`, `extras.in_reflections`,
/// `extras.receive_gi`, `extras.lightmap_scale`, `extras.stitch_seams` and `extras.light_probes` of
/// a node (inherited); cameras; `extras.sky.radiance` of the scene, three numbers;
/// KHR_materials_unlit; extras of a light or of its node, and of materials (docs/scenes.md);
/// `extras.light_probe_group: true` of a node, whose POINTS primitive, or else whose child nodes,
/// are the probes, or a box of probes by `extras.probe_resolution`, with `extras.dering` and
/// `extras.rendering_layers`; `extras.probe_adjustment` of a node. Unknown light types and missing
/// optional features become warnings.
///
/// Returns corrupt if the file breaks the rules of glTF, invalid_argument if a value of extras is
/// out of range, unsupported if the file requires an extension that is not listed here, and
/// not_found (or the system's reason) if it refers to a file that cannot be read. If the scene
/// needs more memory than is free, returns out_of_resources before it decodes it. Messages name the
/// file, the element and the value; fields name the member: `materials[2].alphaCutoff`.
[[nodiscard]] Result<Scene> read_gltf(const std::string& path, const SceneReading& reading = {});

}  // namespace tetralight
