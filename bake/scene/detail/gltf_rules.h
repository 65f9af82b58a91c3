// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The value at a path of keys separated by '/'; null if there is none.
[[nodiscard]] const nlohmann::json* find_json(const nlohmann::json& value, std::string_view path);

/// Checks all elements of all sections against the rules of gltf_schema.h. Returns corrupt with the
/// property as the field, `nodes[3].extras.dering`, if one does not obey.
[[nodiscard]] Status check_gltf_sections(const nlohmann::json& document);

}  // namespace tetralight::detail
