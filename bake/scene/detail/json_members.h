// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

// Checks that all readers of JSON files share. Fields of errors are relative (error_field.h).

namespace tetralight::detail {

/// A value as messages show it: as JSON, cut off after 40 characters.
[[nodiscard]] std::string shown_json(const nlohmann::json& value);

/// Returns corrupt: `NAME is not WANTED (VALUE)`, with the field `.NAME`.
[[nodiscard]] Error wrong_type(const nlohmann::json& value, std::string_view name,
                               std::string_view wanted);

/// Returns corrupt if the object has a key that is not in `known`.
[[nodiscard]] Status check_keys(const nlohmann::json& object,
                                std::initializer_list<std::string_view> known);

}  // namespace tetralight::detail
