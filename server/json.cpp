// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/json.h>

#include <tetralight/base/json/json_text.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Response json_response(const Json& json, unsigned status) {
    return {.status = status, .body = dump(json) + "\n"};
}

namespace {

/// Colons outside of strings. Valid JSON has one for each member of each object.
size_t count_colons(std::string_view text) {
    size_t count = 0;
    bool is_in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') is_in_string = !is_in_string;
        if (!is_in_string) {
            count += c == ':';
        } else if (c == '\\') {
            ++i;  // an escaped character does not end the string
        }
    }
    return count;
}

/// Members of an object or array and of all within it.
size_t count_members(const Json& json) {
    size_t count = json.is_object() ? json.size() : 0;
    for (const Json& value : json) {
        if (value.is_structured()) count += count_members(value);
    }
    return count;
}

/// Refuses an object that has a key twice: parsers differ in which of the values they take. The
/// parsed object kept one member of those with the same key, so their number tells.
void check_duplicates(std::string_view text, const Json& json) {
    const size_t count = count_colons(text);
    if (count == json.size() || count == count_members(json)) return;
    const std::string key = find_duplicate_key(text).value_or("");
    throw Problem{422, "duplicate_member", "\"" + key + "\" is given twice in one object", key};
}

}  // namespace

Json parse_object(std::string_view body, const Json::parser_callback_t& callback) {
    if (auto status = check_json_shape(body); !status) {
        throw Problem{400, "invalid_json", detail_of(status.error()), "body"};
    }
    try {
        Json json = Json::parse(body, callback);
        if (json.is_object()) {
            check_duplicates(body, json);
            return json;
        }
        throw Problem{400, "invalid_json", "the body is not a JSON object", "body"};
    } catch (const Json::exception& exception) {
        throw Problem{400, "invalid_json", json_error_reason(exception), "body"};
    }
}

Json object_in(std::string_view text) {
    Json json = Json::parse(text, nullptr, false);
    return json.is_object() ? json : Json::object();
}

Json object_in(std::span<const std::byte> text) {
    return object_in({reinterpret_cast<const char*>(text.data()), text.size()});
}

std::string shown(const Json& value) {
    constexpr size_t kLongest = 80;
    const std::string all = value.is_string() ? value.get<std::string>() : dump(value);
    return all.substr(0, kLongest);
}

void refuse(const std::string& key, const Json& value, const std::string& expected) {
    throw Problem{400, "invalid_value", key + ": is not " + expected, key, shown(value)};
}

const Json* Fields::find(const std::string& key) {
    asked_.insert(key);
    const auto found = object_.find(key);
    return found == object_.end() || found->is_null() ? nullptr : &*found;
}

std::string Fields::text(const std::string& key, const std::string& otherwise) {
    const Json* value = find(key);
    if (value == nullptr) return otherwise;
    if (!value->is_string()) refuse(key, *value, "a string");
    return value->get<std::string>();
}

std::string Fields::required_text(const std::string& key) {
    if (find(key) == nullptr) throw Problem{400, "missing_value", key + ": is not given", key};
    return text(key);
}

bool Fields::flag(const std::string& key) {
    const Json* value = find(key);
    if (value == nullptr) return false;
    if (!value->is_boolean()) refuse(key, *value, "true or false");
    return value->get<bool>();
}

double Fields::number(const std::string& key, double otherwise) {
    const Json* value = find(key);
    if (value == nullptr) return otherwise;
    if (!value->is_number()) refuse(key, *value, "a number");
    return value->get<double>();
}

std::vector<std::string> Fields::texts(const std::string& key) {
    const Json* value = find(key);
    if (value == nullptr) return {};
    if (!value->is_array()) refuse(key, *value, "an array of strings");
    std::vector<std::string> texts;
    for (const Json& element : *value) {
        if (!element.is_string()) {
            refuse(key + "[" + std::to_string(texts.size()) + "]", element, "a string");
        }
        texts.push_back(element.get<std::string>());
    }
    return texts;
}

void Fields::finish() const {
    for (const auto& [key, value] : object_.items()) {
        if (!asked_.contains(key)) {
            throw Problem{400, "unknown_member", "\"" + key + "\" is not known here", key,
                          shown(value)};
        }
    }
}

}  // namespace tetralight::server
