// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Whether a reader reads normal maps and tangents. Most bakes do not use them.
enum class NormalMaps : bool { Skip, Read };

/// Reads a glTF 2.0 scene (.gltf or .glb): its default scene's node hierarchy flattened into
/// instances.
///
/// Read: indexed and non-indexed triangles, strips and fans; base colour and emission with textures
/// (KHR_texture_transform, KHR_materials_emissive_strength); normal maps and tangents if asked for;
/// KHR_lights_punctual;
/// EXT_mesh_gpu_instancing; KHR_mesh_quantization; `extras.contribute_gi`,
/// `extras.portal` and `extras.reflection_probe` of a node; `extras.walkable`,
/// `extras.in_reflections`, `extras.receive_gi`, `extras.lightmap_scale`, `extras.stitch_seams` and
/// `extras.light_probes` of a node (inherited); perspective cameras; `extras.sky.radiance` of the
/// scene, three numbers; KHR_materials_unlit; extras of a light or of its node, and of materials
/// (docs/scenes.md); `extras.light_probe_group: true` of a node, whose POINTS primitive, or else
/// whose child nodes, are the probes, with `extras.dering` and `extras.rendering_layers`;
/// `extras.probe_adjustment` of a node. Unknown light types and missing optional features become
/// warnings.
///
/// Returns corrupt if the file breaks the rules of glTF, invalid_argument if a value of extras is
/// out of range, unsupported if the file requires an extension that is not listed here, and
/// not_found (or the system's reason) if it refers to a file that cannot be read. Messages name the
/// file, the element and the value; fields name the member: `materials[2].alphaCutoff`.
[[nodiscard]] Result<Scene> read_gltf(const std::string& path,
                                      NormalMaps normal_maps = NormalMaps::Skip);

}  // namespace tetralight
