// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {scene_file("glTF 2.0 scene (.glb or .gltf)")};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kExplain{.command = "explain",
                     .summary =
                         "List what is read of a scene, what is approximated, and what is "
                         "ignored",
                     .examples =
                         "tetralight explain courtyard.glb\n"
                         "tetralight explain courtyard.glb --time 2.5 --json",
                     .groups = kGroups};

}  // namespace tetralight::settings
