// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>

// Puts the UVs of lightmaps, and their pages, into the glTF file of a scene
// (bake/scene/lightmap_glb.h).

namespace tetralight {

/// Writes the scene at `scene_path` that `reading` chooses with the UVs of `layout` as a .glb file;
/// places are extras of nodes. Precondition: the layout is that of the scene that `read_gltf` reads
/// so. Returns the errors of `make_lightmap_glb` and of writing.
[[nodiscard]] Status write_unwrapped_glb(const std::string& path, const std::string& scene_path,
                                         const LightmapLayout& layout,
                                         const SceneReading& reading = {});

/// Writes the scene at `scene_path`, which is `scene` if it is read so, with lightmaps as a .glb
/// file: TEXCOORD_1, and pages as RGBM images of MX_lightmap. Returns the errors of
/// `check_lightmap_scene` and of `write_unwrapped_glb`.
[[nodiscard]] Status write_lightmap_glb(const std::string& path, const std::string& scene_path,
                                        const Scene& scene, const LightmapsView& lightmaps,
                                        const SceneReading& reading = {});

}  // namespace tetralight
