// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// Prints what is read of a scene, as `tetralight explain` and `tetralight info` do. Returns the
/// errors of `read_scene`.
[[nodiscard]] Status show_scene(const std::string& path, const SceneReading& reading,
                                const CommonOptions& common);

}  // namespace tetralight::cli
