// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/bake/scene/scene_parts.h>

namespace tetralight::detail {

/// What read_gltf() does with an extension of glTF.
struct GltfExtension {
    std::string_view name;
    PartUse use = PartUse::Read;
    /// True if a file may require the extension.
    bool may_be_required = true;
    bool changes_light = false;
    std::string_view note = {};
    std::string_view remedy = {};
};

/// Null for extensions that are not known.
[[nodiscard]] const GltfExtension* find_gltf_extension(std::string_view name);

}  // namespace tetralight::detail
