// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_parts.h>
#include <tetralight/settings/values.h>

// The table of what was read of a scene: parts that are read come first, then those that are
// approximated, then those that are ignored.

namespace tetralight::cli {

/// The rows as an array of objects.
[[nodiscard]] settings::Json parts_json(const std::vector<ScenePart>& parts);

/// The rows as lines of at most 96 characters, with a heading; a name that has no blanks may make
/// its line longer. Empty without rows.
[[nodiscard]] std::string parts_text(const std::vector<ScenePart>& parts);

/// The scene's warnings without those that the table contains.
[[nodiscard]] std::vector<std::string> warnings_beside_parts(const Scene& scene);

}  // namespace tetralight::cli
