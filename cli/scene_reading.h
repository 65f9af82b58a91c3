// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>

namespace tetralight::cli {

/// How the settings of a command say that its scene is read.
[[nodiscard]] SceneReading scene_reading(const Values& values,
                                         NormalMaps normal_maps = NormalMaps::Skip);

/// Returns invalid_argument with this message about a setting of `scene_reading`, if the user gave
/// one.
[[nodiscard]] Status check_no_scene_reading(const Values& values, std::string_view message);

/// As `read_gltf`. Errors name the settings of `scene_reading`, and say so if the file contains
/// probe groups.
[[nodiscard]] Result<Scene> read_scene(const std::string& path, const SceneReading& reading);

/// Warnings with the file before them.
[[nodiscard]] std::vector<std::string> in_file(const std::string& path,
                                               std::vector<std::string> warnings);

/// The same error; if it is about too many probes or texels and the scene may be in centimetres, it
/// says so.
[[nodiscard]] Error with_size_hint(const Error& error, const Scene& scene);

/// True if the file is a glTF scene by its contents: it begins as a .glb file does, or is a JSON
/// object with a member "asset".
[[nodiscard]] bool is_scene_file(const std::string& path);

}  // namespace tetralight::cli
