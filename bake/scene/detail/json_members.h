// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
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

/// An integer that may be written as 3.0, as some exporters do; none if it is anything else, or out
/// of range.
[[nodiscard]] std::optional<int32_t> read_int32(const nlohmann::json& value);

/// Reads the number of a key; leaves `number` unchanged if the key is absent. Returns corrupt if
/// the value is not a number.
[[nodiscard]] Status read_number(const nlohmann::json& object, const char* key,
                                 std::optional<double>& number);
[[nodiscard]] Status read_number(const nlohmann::json& object, const char* key,
                                 std::optional<float>& number);

/// The same for an array of three numbers.
[[nodiscard]] Status read_vec3(const nlohmann::json& object, const char* key, glm::dvec3& v);

/// A file of JSON. Returns corrupt for syntax errors, too much nesting, and a key that an object
/// has twice.
[[nodiscard]] Result<nlohmann::json> parse_json(std::span<const std::byte> bytes);

/// Three numbers; none if the value is anything else.
[[nodiscard]] std::optional<glm::dvec3> read_vec3(const nlohmann::json& value);

/// The mask of a list of rendering layers, `[0, 3]`. Returns corrupt if it is not an array of
/// integers from 0 to 31, or empty.
[[nodiscard]] Result<uint32_t> read_rendering_layers(const nlohmann::json& value,
                                                     std::string_view name);

/// The layers of a mask, ascending.
[[nodiscard]] std::vector<uint32_t> rendering_layer_list(uint32_t mask);

}  // namespace tetralight::detail
