// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/json/json_text.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include <tetralight/base/str_cat.h>

namespace tetralight {

Status check_json_shape(std::string_view json) {
    int depth = 0;
    std::array<int, kDeepestJson + 1> member_counts{};
    bool is_in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_in_string) {
            i += c == '\\';  // an escaped character does not end the string
            is_in_string = c != '"';
        } else if (c == '"') {
            is_in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kDeepestJson) {
                return Error{ErrorCode::InvalidArgument,
                             str_cat("JSON is nested deeper than ", kDeepestJson)};
            }
            member_counts[static_cast<size_t>(depth)] = 0;
        } else if (c == ':') {
            if (++member_counts[static_cast<size_t>(depth)] > kMostJsonMembers) {
                return Error{ErrorCode::InvalidArgument,
                             str_cat("a JSON object has more than ", kMostJsonMembers, " members")};
            }
        } else if (c == ']' || c == '}') {
            if (--depth < 0) return Ok{};  // a parser reads no further
        }
    }
    return Ok{};
}

Status check_json_object(std::string_view json) {
    if (auto status = check_json_shape(json); !status) return status;
    try {
        if (nlohmann::json::parse(json).is_object()) return Ok{};
    } catch (const nlohmann::json::exception& exception) {
        return Error{ErrorCode::InvalidArgument,
                     "is not a JSON object (" + json_error_reason(exception) + ")"};
    }
    return Error{ErrorCode::InvalidArgument, "is not a JSON object"};
}

std::optional<std::string> find_duplicate_key(std::string_view json) {
    using Json = nlohmann::json;
    std::vector<std::set<std::string>> keys;
    std::optional<std::string> duplicate;
    const auto look = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event != Json::parse_event_t::key) return true;
        const std::string key = value.get<std::string>();
        if (!keys.back().insert(key).second && !duplicate) duplicate = key;
        return true;
    };
    [[maybe_unused]] const Json ignored = Json::parse(json, look);
    return duplicate;
}

std::string json_error_reason(const std::exception& exception) {
    const std::string message = exception.what();
    const size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
    return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace tetralight
