// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/server/http.h>

namespace tetralight::server {

using Json = nlohmann::ordered_json;

/// On one line. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string dump(const Json& json);

[[nodiscard]] Response json_response(const Json& json, unsigned status = 200);

/// The JSON object of a body. Throws a `Problem`: 400 if it is nested too deep, not JSON or no
/// object, 422 "duplicate_member" if an object in it has a key twice. The callback, if any, sees
/// what is parsed, and may drop values that are not in objects.
[[nodiscard]] Json parse_object(std::string_view body,
                                const Json::parser_callback_t& callback = nullptr);

/// The JSON object of a text that may be damaged; an empty object if there is none.
[[nodiscard]] Json object_in(std::string_view text);
[[nodiscard]] Json object_in(std::span<const std::byte> text);

/// Reads an object member by member and records which members were read. All functions throw a
/// `Problem` that names the member and its value.
class Fields {
  public:
    /// Keeps a reference.
    explicit Fields(const Json& object) : object_(object) {}

    /// Null if the member is missing or null.
    [[nodiscard]] const Json* find(const std::string& key);

    [[nodiscard]] std::string text(const std::string& key, const std::string& otherwise = "");
    [[nodiscard]] std::string required_text(const std::string& key);
    [[nodiscard]] bool flag(const std::string& key);
    [[nodiscard]] double number(const std::string& key, double otherwise);
    [[nodiscard]] std::vector<std::string> texts(const std::string& key);

    /// Call it at the end: refuses members that were not read.
    void finish() const;

  private:
    const Json& object_;
    std::set<std::string> asked_;
};

/// A value as a `Problem` shows it: strings without quotes, all else as JSON; up to 80 bytes.
[[nodiscard]] std::string shown(const Json& value);

/// Throws a `Problem`: member `key` is not `expected`.
[[noreturn]] void refuse(const std::string& key, const Json& value, const std::string& expected);

}  // namespace tetralight::server
