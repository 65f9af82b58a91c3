// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

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

/// The mask of a list of rendering layers, `[0, 3]`. Returns corrupt if it is not an array of
/// integers from 0 to 31, or empty.
[[nodiscard]] Result<uint32_t> read_rendering_layers(const nlohmann::json& value,
                                                     std::string_view name);

/// The layers of a mask, ascending.
[[nodiscard]] std::vector<uint32_t> rendering_layer_list(uint32_t mask);

}  // namespace tetralight::detail
