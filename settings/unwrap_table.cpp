// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    scene_file("glTF 2.0 scene (.glb or .gltf)"),
    output_file(".glb", "Scene with the UVs of lightmaps as TEXCOORD_1 (- = stdout)")};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Pages", kLightmapPages},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kUnwrap{.command = "unwrap",
                    .summary = "Write a scene with the UVs that its lightmaps have",
                    .examples =
                        "tetralight unwrap courtyard.glb -o uv1.glb\n"
                        "tetralight unwrap courtyard.glb -t 20 --uvs repair -o uv1.glb",
                    .groups = kGroups};

}  // namespace tetralight::settings
