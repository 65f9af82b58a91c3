// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/value_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/settings/detail/checked_value.h>

namespace tetralight::settings {
namespace {

using detail::checked_integer;
using detail::checked_number;
using detail::invalid;
using detail::joined;
using detail::not_a;
using detail::words_of;

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

Result<Json> number_from_text(const Setting& setting, std::string_view text) {
    const auto number = parse_number(text);
    if (!number) return not_a(text, "a number");
    return checked_number(setting, *number, text);
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
    const Error error =
        not_a(text, "a range of one or more, such as 0..100, 100.., or 3..100x8 for every eighth");
    const size_t dots = text.find("..");
    if (dots == std::string_view::npos) return error;
    const size_t x = text.find('x', dots);
    const auto begin = parse_integer(text.substr(0, dots));
    const auto step = x == std::string_view::npos ? 1 : parse_integer(text.substr(x + 1));
    if (!begin || *begin >= kMost || !step || *step == 0 || *step > kMost) return error;
    const std::string_view end_text =
        text.substr(dots + 2, x == std::string_view::npos ? x : x - dots - 2);
    const auto end = end_text.empty() ? kMost : parse_integer(end_text);
    if (!end || *end <= *begin || *end > kMost) return error;
    return Json::array({*begin, *end, *step});
}

Result<Json> choice_from_text(const Setting& setting, std::string_view text) {
    const auto words = words_of(setting.choices);
    if (std::ranges::find(words, text) != words.end()) return Json(text);
    return not_a(text, "one of " + joined(words, ""));
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
    const auto known = words_of(setting.extensions);
    if (extension.empty() || std::ranges::find(known, lower(extension)) != known.end()) {
        return Json(text);
    }
    return invalid(text, str_cat("cannot write \"", extension, "\" files; the extension may be ",
                                 joined(known, ""), ", or none"));
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

}  // namespace tetralight::settings
