// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/json/json_text.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include <tetralight/base/json/json_visitor.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Ends at the first key that an object has twice.
class DuplicateFinder : public JsonVisitor {
  public:
    bool start_object(size_t) override {
        keys_.emplace_back();
        return true;
    }

    bool key(string_t& name) override {
        if (!keys_.back().insert(name).second) duplicate = name;
        return !duplicate;
    }

    bool end_object() override {
        keys_.pop_back();
        return true;
    }

    std::optional<std::string> duplicate;

  private:
    std::vector<std::set<std::string>> keys_;
};

}  // namespace

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
    DuplicateFinder finder;
    nlohmann::json::sax_parse(json, &finder);
    return finder.duplicate;
}

std::string json_error_reason(const std::exception& exception) {
    const std::string message = exception.what();
    const size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
    return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace tetralight
