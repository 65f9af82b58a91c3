// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/value_json.h>

#include <cmath>
#include <optional>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/settings/detail/checked_value.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::settings {
namespace {

using detail::checked_integer;
using detail::checked_number;
using detail::joined;
using detail::not_a;
using detail::words_of;

/// What the text of an option would be, where JSON has a text; else nothing.
std::optional<std::string> plain_text(const Json& json) {
    if (!json.is_string()) return std::nullopt;
    auto text = json.get<std::string>();
    return has_control_character(text) ? std::nullopt : std::optional(std::move(text));
}

/// JSON does not tell 16 from 16.0 (RFC 8259): both are whole.
std::optional<uint64_t> whole_number(const Json& json) {
    if (json.is_number_unsigned()) return json.get<uint64_t>();
    if (json.is_number_integer() && json >= 0) return json.get<uint64_t>();
    if (!json.is_number_float()) return std::nullopt;
    const auto number = json.get<double>();
    const bool is_whole = number >= 0.0 && number < 0x1p64 && std::trunc(number) == number;
    return is_whole ? std::optional(static_cast<uint64_t>(number)) : std::nullopt;
}

/// What a text setting takes.
std::string text_form(const Setting& setting) {
    switch (setting.type) {
        case Type::Sky:
            return "a number, an array of three or the path of a file";
        case Type::Fraction:
        case Type::Seconds:
            return "a number or a text";
        case Type::Choice:
            return "one of " + joined(words_of(setting.choices), "\"");
        default:
            return "a text";
    }
}

Result<Json> number_from_json(const Setting& setting, const Json& json) {
    const std::string shown = shown_value(json);
    const bool is_whole = setting.type == Type::Integer || setting.type == Type::Integers;
    if (is_whole) return checked_integer(setting, whole_number(json), shown);
    if (!json.is_number()) return not_a(shown, "a number");
    return checked_number(setting, json.get<double>(), shown);
}

Result<Json> numbers_from_json(const Setting& setting, const Json& json, size_t count) {
    const std::string shown = shown_value(json);
    const bool has_count = json.is_array() && !json.empty() && (count == 0 || json.size() == count);
    if (!has_count) {
        return not_a(
            shown, count > 0 ? str_cat("an array of ", count, " numbers") : "an array of numbers");
    }
    Json numbers = Json::array();
    for (const Json& element : json) {
        auto number = number_from_json(setting, element);
        if (!number) return number;
        numbers.push_back(*number);
    }
    return numbers;
}

Result<Json> vector_from_json(const Setting& setting, const Json& json) {
    if (json.is_number() && setting.type == Type::Scale) {
        return numbers_from_json(setting, Json::array({json, json, json}), 3);
    }
    auto vector = numbers_from_json(setting, json, 3);
    const Json zero = Json::array({0.0, 0.0, 0.0});
    if (vector && setting.type == Type::Direction && *vector == zero) {
        return not_a(shown_value(json), "a direction");
    }
    return vector;
}

Result<Json> words_from_json(const Json& json) {
    if (!json.is_array() || json.empty()) return not_a(shown_value(json), "an array of texts");
    for (const Json& word : json) {
        const auto text = plain_text(word);
        const bool is_word = text && !text->empty() && text->find(',') == std::string::npos;
        if (!is_word) return not_a(shown_value(word), "a text without commas and line breaks");
    }
    return json;
}

Result<Json> weights_from_json(const Json& json) {
    if (!json.is_object() || json.empty()) return not_a(shown_value(json), "an object of numbers");
    Json weights = Json::object();
    for (const auto& [name, weight] : json.items()) {
        if (!weight.is_number()) {
            return not_a(shown_value(weight), str_cat("a number, the weight of \"", name, "\""));
        }
        if (name.empty() || name.find(',') != std::string::npos) {
            return not_a(name, "the name of a layer");
        }
        weights[name] = weight.get<double>();
    }
    return weights;
}

}  // namespace

Result<Json> value_from_json(const Setting& setting, const Json& json) {
    switch (setting.type) {
        case Type::Flag:
            return json.is_boolean() ? Result<Json>(json)
                                     : not_a(shown_value(json), "true or false");
        case Type::Integer:
        case Type::Number:
            return number_from_json(setting, json);
        case Type::Vector:
        case Type::Direction:
        case Type::Scale:
            return vector_from_json(setting, json);
        case Type::Numbers:
        case Type::Integers:
            return numbers_from_json(setting, json, setting.count);
        case Type::Words:
            return words_from_json(json);
        case Type::Weights:
            return weights_from_json(json);
        case Type::Sky:
            if (json.is_number()) return number_from_json(setting, json);
            if (json.is_array()) return vector_from_json(setting, json);
            break;
        case Type::Fraction:
        case Type::Seconds:
            if (json.is_number()) return value_from_text(setting, json.dump());
            break;
        case Type::Range:
        case Type::Text:
        case Type::Choice:
        case Type::Path:
            break;
    }
    if (!json.is_string()) return not_a(shown_value(json), text_form(setting));
    const auto text = plain_text(json);
    if (!text) return not_a(shown_value(json), "a text without line breaks");
    return value_from_text(setting, *text);
}

std::string shown_value(const Json& value) {
    constexpr size_t kMost = 200;
    std::string text = value.is_string()
                           ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > kMost) text = text.substr(0, kMost) + "...";
    return text;
}

}  // namespace tetralight::settings
