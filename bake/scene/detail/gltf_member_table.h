// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace tetralight::detail {

/// The members of the elements of a section, or of an object in them.
struct GltfMembers {
    /// What messages call the object.
    std::string_view object;
    /// Empty: the file itself.
    std::string_view section;
    /// The path of the object in its element, separated by '/'; of lists, all objects count.
    std::string_view path;
    /// Without `extensions` and `extras`, which all objects may have.
    std::span<const std::string_view> names;
};

/// The members that glTF 2.0 defines (chapter 5), and those of KHR_lights_punctual and
/// KHR_materials_emissive_strength.
[[nodiscard]] std::span<const GltfMembers> gltf_member_table();

}  // namespace tetralight::detail
