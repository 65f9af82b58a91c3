// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/value_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include <tetralight/base/str_cat.h>

namespace tetralight::settings {
namespace {

using Texts = std::vector<std::string>;

Error invalid(std::string_view value, std::string_view message) {
    return {ErrorCode::InvalidArgument, "", std::string(value), Message(std::string(message))};
}

Error not_a(std::string_view value, std::string_view what) {
    return invalid(value, str_cat("\"", value, "\" is not ", what));
}

std::string whole_number_text(const Range& range) {
    return "a whole number from " + number_text(std::max(range.min, 0.0)) + " to " +
           number_text(std::isfinite(range.max) ? range.max : 0x1p64);
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
    std::vector<std::string_view> parts;
    while (true) {
        const size_t end = std::min(text.find(','), text.size());
        parts.push_back(text.substr(0, end));
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

/// Numbers that no double holds become infinite.
std::optional<double> parse_number(std::string_view text) {
    double number = 0.0;
    const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc::invalid_argument || next != text.data() + text.size()) {
        return std::nullopt;
    }
    if (error == std::errc{}) return number;
    return text.starts_with('-') ? -HUGE_VAL : HUGE_VAL;
}

std::optional<uint64_t> parse_integer(std::string_view text) {
    uint64_t number = 0;
    const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc{} && next == text.data() + text.size();
    return is_whole ? std::optional(number) : std::nullopt;
}

Result<Json> checked_number(const Setting& setting, double number, std::string_view shown) {
    const Range& range = setting.range;
    const bool is_above = range.excludes_min ? number > range.min : number >= range.min;
    if (std::isnan(number)) return not_a(shown, "a number");
    if (std::isfinite(number) && is_above && number <= range.max) return Json(number);
    const std::string allowed = range_text(range);
    if (allowed.empty()) return not_a(shown, "a finite number");
    return invalid(shown, str_cat(shown, " is not in the range ", allowed));
}

Result<Json> number_from_text(const Setting& setting, std::string_view text) {
    const auto number = parse_number(text);
    if (!number) return not_a(text, "a number");
    return checked_number(setting, *number, text);
}

Result<Json> checked_integer(const Setting& setting, std::optional<uint64_t> number,
                             std::string_view shown) {
    const Range& range = setting.range;
    const auto value = static_cast<double>(number.value_or(0));
    if (number && value >= range.min && value <= range.max) return Json(*number);
    return not_a(shown, whole_number_text(range));
}

Result<Json> fraction_from_text(std::string_view text) {
    const bool is_percent = text.ends_with('%');
    auto number = parse_number(text.substr(0, text.size() - is_percent));
    if (number && is_percent) *number /= 100.0;
    if (number && *number > 0.0 && *number <= 1.0) return Json(*number);
    return not_a(text, "a fraction above 0, up to 1, such as 1% or 0.01");
}

Result<Json> seconds_from_text(std::string_view text) {
    std::string_view number = text;
    double unit = 1.0;
    if (!number.empty() && std::string_view("smh").find(number.back()) != std::string_view::npos) {
        unit = number.back() == 's' ? 1.0 : number.back() == 'm' ? 60.0 : 3600.0;
        number.remove_suffix(1);
    }
    constexpr double kLongest = 1e9;
    const auto amount = parse_number(number);
    if (amount && *amount > 0.0 && *amount * unit < kLongest) return Json(*amount * unit);
    return not_a(text, "a time above 0, such as 30s, 5m or 2h");
}

Result<Json> range_from_text(std::string_view text) {
    constexpr uint64_t kMost = UINT32_MAX;
    const Error error = not_a(text, "a range of one or more, such as 0..100 or 100..");
    const size_t dots = text.find("..");
    if (dots == std::string_view::npos) return error;
    const auto begin = parse_integer(text.substr(0, dots));
    const std::string_view rest = text.substr(dots + 2);
    if (!begin || *begin >= kMost) return error;
    if (rest.empty()) return Json::array({*begin});
    const auto end = parse_integer(rest);
    if (!end || *end <= *begin || *end > kMost) return error;
    return Json::array({*begin, *end});
}

Result<Json> choice_from_text(const Setting& setting, std::string_view text) {
    bool is_one = false;
    std::string words;
    for_each_word(setting.choices, [&](std::string_view word) {
        is_one = is_one || word == text;
        words += str_cat(words.empty() ? "" : ", ", word);
    });
    if (is_one) return Json(text);
    return not_a(text, "one of " + words);
}

std::string lower(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

Result<Json> path_from_text(const Setting& setting, std::string_view text) {
    if (text.empty()) return invalid(text, "the path is empty");
    if (setting.extensions.empty()) return Json(text);
    const std::string extension = std::filesystem::path(text).extension().string();
    bool is_known = extension.empty();
    std::string known;
    for_each_word(setting.extensions, [&](std::string_view word) {
        is_known = is_known || word == lower(extension);
        known += str_cat(known.empty() ? "" : ", ", word);
    });
    if (is_known) return Json(text);
    return invalid(text, str_cat("cannot write \"", extension, "\" files; the extension may be ",
                                 known, ", or none"));
}

Result<Json> numbers_from_text(const Setting& setting, std::string_view text, size_t count,
                               std::string_view form) {
    const auto parts = split_at_commas(text);
    if (count > 0 && parts.size() != count) return not_a(text, form);
    Json numbers = Json::array();
    for (const std::string_view part : parts) {
        if (count > 0 && !parse_number(part)) return not_a(text, form);
        const auto number = setting.type == Type::Integers
                                ? checked_integer(setting, parse_integer(part), part)
                                : number_from_text(setting, part);
        if (!number) return number;
        numbers.push_back(*number);
    }
    return numbers;
}

Result<Json> vector_from_text(const Setting& setting, std::string_view text) {
    auto vector = numbers_from_text(setting, text, 3, "of the form x,y,z");
    const Json zero = Json::array({0.0, 0.0, 0.0});
    if (vector && setting.type == Type::Direction && *vector == zero) {
        return not_a(text, "a direction");
    }
    return vector;
}

Result<Json> scale_from_text(const Setting& setting, std::string_view text) {
    if (text.find(',') != std::string_view::npos) return vector_from_text(setting, text);
    if (!parse_number(text)) return not_a(text, "a number or x,y,z");
    const auto number = number_from_text(setting, text);
    if (!number) return number;
    return Json::array({*number, *number, *number});
}

bool are_numbers(std::string_view text) {
    const auto parts = split_at_commas(text);
    return (parts.size() == 1 || parts.size() == 3) &&
           std::ranges::all_of(parts, [](auto part) { return parse_number(part).has_value(); });
}

/// A file that is not there and has commas in its name was meant to be a color.
Result<Json> sky_from_text(const Setting& setting, std::string_view text) {
    if (are_numbers(text)) {
        return text.find(',') == std::string_view::npos ? number_from_text(setting, text)
                                                        : vector_from_text(setting, text);
    }
    std::error_code error;
    const bool has_comma = text.find(',') != std::string_view::npos;
    if (!text.empty() && (!has_comma || std::filesystem::exists(std::string(text), error))) {
        return Json(text);
    }
    return invalid(text, str_cat("\"", text, "\" is neither R,G,B, nor a number, nor a file"));
}

Result<Json> words_from_text(std::string_view text) {
    Json words = Json::array();
    for (const std::string_view word : split_at_commas(text)) words.push_back(word);
    return words;
}

/// "lamp=0.5"; blanks before it are allowed. Weights that no double holds become infinite; the
/// library refuses them by the name of their layer.
Result<Json> weights_from_text(std::string_view text) {
    Json weights = Json::object();
    for (std::string_view part : split_at_commas(text)) {
        const std::string_view whole = part;
        part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
        const size_t equals = part.rfind('=');
        const bool has_name = equals != std::string_view::npos && equals > 0;
        const auto weight = has_name ? parse_number(part.substr(equals + 1)) : std::nullopt;
        if (!weight) return not_a(whole, "of the form LAYER=WEIGHT");
        const std::string layer(part.substr(0, equals));
        if (weights.contains(layer)) {
            return invalid(whole, "layer \"" + layer + "\" is given two weights");
        }
        weights[layer] = *weight;
    }
    return weights;
}

Result<Json> flag_from_text(std::string_view text) {
    if (text == "true" || text == "false") return Json(text == "true");
    return not_a(text, "true or false");
}

bool has_control_character(std::string_view text) {
    constexpr char kDelete = 0x7f;
    return std::ranges::any_of(text, [](char c) { return (c >= 0 && c < ' ') || c == kDelete; });
}

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
        case Type::Choice: {
            std::string words;
            for_each_word(setting.choices, [&](std::string_view word) {
                words += str_cat(words.empty() ? "one of \"" : ", \"", word, "\"");
            });
            return words;
        }
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

Result<Json> value_from_text(const Setting& setting, std::string_view text) {
    switch (setting.type) {
        case Type::Flag:
            return flag_from_text(text);
        case Type::Integer:
            return checked_integer(setting, parse_integer(text), text);
        case Type::Number:
            return number_from_text(setting, text);
        case Type::Fraction:
            return fraction_from_text(text);
        case Type::Seconds:
            return seconds_from_text(text);
        case Type::Range:
            return range_from_text(text);
        case Type::Text:
            if (!text.empty()) return Json(text);
            return invalid(
                text, setting.value_name == "NAME" ? "the name is empty" : "the text is empty");
        case Type::Choice:
            return choice_from_text(setting, text);
        case Type::Path:
            return path_from_text(setting, text);
        case Type::Vector:
        case Type::Direction:
            return vector_from_text(setting, text);
        case Type::Scale:
            return scale_from_text(setting, text);
        case Type::Sky:
            return sky_from_text(setting, text);
        case Type::Numbers:
        case Type::Integers:
            return numbers_from_text(setting, text, setting.count,
                                     str_cat(setting.count, " numbers with commas between"));
        case Type::Words:
            return words_from_text(text);
        case Type::Weights:
            return weights_from_text(text);
    }
    return not_a(text, "a value");
}

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
