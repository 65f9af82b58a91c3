// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// What is to be baked of one scene.
struct SceneOrder {
    std::string place;  ///< for messages: "order.json: scenes[0]", or the path of the scene
    std::string name;   ///< of the files that are written
    /// Settings of `bake`, `lightmap` and `reflect` with absolute paths; nothing: not baked.
    std::optional<Json> probes{};
    std::optional<Json> lightmaps{};
    std::optional<Json> reflections{};
    /// Of its results, as `settings::kLimits` has them.
    Json limits = Json::object();
    /// The scene was named instead of an order: what it has nothing for is left out.
    bool is_by_scene = false;
};

/// Reads an order (.json), or makes one of a scene (.glb or .gltf) that asks for everything. All
/// settings are checked one by one. Returns invalid_argument with file, scene and setting.
[[nodiscard]] Result<std::vector<SceneOrder>> read_order(const std::string& path);

}  // namespace tetralight::cli
