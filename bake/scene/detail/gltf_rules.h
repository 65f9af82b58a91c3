// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A value as messages show it: as JSON, cut off where it is long.
[[nodiscard]] std::string shown_json(const nlohmann::json& value);

/// Steps from `value` along a path of keys parted by '/'; null where it ends early.
[[nodiscard]] const nlohmann::json* find_json(const nlohmann::json& value, std::string_view path);

/// Checks all elements of all sections against the rules of gltf_schema.h.
[[nodiscard]] Status check_gltf_sections(const nlohmann::json& document);

}  // namespace tetralight::detail
