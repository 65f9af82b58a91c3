// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include <tetralight/bake/scene/scene_parts.h>

namespace tetralight::detail {

/// Puts a blank in place of each line break and other control character of the names of elements:
/// files of volumes and lightmaps have one name a line. Returns a part that has them; none if no
/// name has such characters.
[[nodiscard]] std::vector<ScenePart> clean_names(nlohmann::json& document);

}  // namespace tetralight::detail
