// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/godot_text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

/// More than Godot writes.
constexpr size_t kMostAttributes = 64;

constexpr std::string_view kSpace = " \t\r\n";

Error godot_error(size_t line, std::string_view message) {
    return {ErrorCode::Corrupt, str_cat(line, ": ", message)};
}

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

void append_utf8(uint32_t code, std::string& text) {
    const auto byte = [&](uint32_t value) { text += static_cast<char>(value); };
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xc0 | code >> 6);
        byte(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        byte(0xe0 | code >> 12);
        byte(0x80 | (code >> 6 & 0x3f));
        byte(0x80 | (code & 0x3f));
    } else {
        byte(0xf0 | code >> 18);
        byte(0x80 | (code >> 12 & 0x3f));
        byte(0x80 | (code >> 6 & 0x3f));
        byte(0x80 | (code & 0x3f));
    }
}

/// Appends the character of an escape, and returns the length of the escape; 0 if there is none.
/// Precondition: `text` follows the backslash.
size_t append_escape(std::string_view text, std::string& result) {
    if (text.empty()) return 0;
    const size_t digits = text[0] == 'u' ? 4 : text[0] == 'U' ? 6 : 0;
    if (digits == 0) {
        constexpr std::string_view kLetters = "abfnrtv";
        constexpr std::string_view kCharacters = "\a\b\f\n\r\t\v";
        const size_t i = kLetters.find(text[0]);
        result += i == std::string_view::npos ? text[0] : kCharacters[i];
        return 1;
    }
    if (text.size() < digits + 1) return 0;
    uint32_t code = 0;
    const char* const first = text.data() + 1;
    const auto [end, error] = std::from_chars(first, first + digits, code, 16);
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (error != std::errc() || end != first + digits || code > 0x10ffff || is_surrogate) return 0;
    append_utf8(code, result);
    return digits + 1;
}

}  // namespace

std::optional<std::string_view> GodotEntry::attribute(std::string_view key) const {
    const auto found = std::ranges::find(attributes, key, &GodotAttribute::key);
    return found == attributes.end() ? std::nullopt : std::optional(found->value);
}

Result<std::optional<std::string>> GodotEntry::text_attribute(std::string_view key) const {
    const auto found = attribute(key);
    if (!found) return std::optional<std::string>();
    auto text = parse_godot_string(*found);
    if (text) return text;
    return Error{ErrorCode::Corrupt, std::string(key), std::string(found->substr(0, 60)),
                 str_cat(key, " is not a string (", quoted_text(*found), ")")};
}

std::string_view GodotText::take(size_t length) {
    const std::string_view text = rest_.substr(0, length);
    line_ += static_cast<size_t>(std::ranges::count(text, '\n'));
    rest_.remove_prefix(text.size());
    return text;
}

void GodotText::skip_space() {
    while (true) {
        take(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
        if (!rest_.starts_with(';')) return;  // a comment
        take(std::min(rest_.find('\n'), rest_.size()));
    }
}

Status GodotText::skip_string() {
    const size_t first_line = line_;
    for (size_t i = 1; i < rest_.size(); ++i) {
        if (rest_[i] == '\\') {
            ++i;
        } else if (rest_[i] == '"') {
            take(i + 1);
            return Ok{};
        }
    }
    return godot_error(first_line, "the string that begins here does not end");
}

Result<std::string_view> GodotText::value(std::string_view ends) {
    const size_t first_line = line_;
    const char* const first = rest_.data();
    size_t depth = 0;
    while (!rest_.empty()) {
        const char letter = rest_.front();
        if (depth == 0 && ends.find(letter) != std::string_view::npos) break;
        if (letter == '"') {
            if (auto status = skip_string(); !status) return status.error();
            continue;
        }
        const bool is_closing = letter == ')' || letter == ']' || letter == '}';
        if (is_closing && depth == 0)
            return godot_error(line_, str_cat("'", letter, "' closes no bracket"));
        if (letter == '(' || letter == '[' || letter == '{') ++depth;
        if (is_closing) --depth;
        if (letter == '\n') ++line_;
        rest_.remove_prefix(1);
    }
    if (depth > 0) return godot_error(first_line, "a bracket of the value is not closed");
    return trimmed({first, static_cast<size_t>(rest_.data() - first)});
}

Result<std::optional<GodotEntry>> GodotText::heading() {
    GodotEntry entry{.is_heading = true, .line = line_};
    rest_.remove_prefix(1);
    skip_space();
    entry.name = take(std::min(rest_.find_first_of("] \t\r\n"), rest_.size()));
    while (true) {
        skip_space();
        if (rest_.empty()) return godot_error(entry.line, "the heading does not end");
        if (rest_.front() == ']') break;
        if (entry.attributes.size() == kMostAttributes) {
            return godot_error(
                entry.line, str_cat("the heading has more than ", kMostAttributes, " attributes"));
        }
        const size_t length = rest_.find_first_of("=]\n");
        if (length == std::string_view::npos || rest_[length] != '=') {
            return godot_error(line_, str_cat("heading \"", entry.name.substr(0, 60),
                                              "\": ", quoted_text(rest_.substr(0, length)),
                                              " is not an attribute"));
        }
        GodotAttribute& attribute = entry.attributes.emplace_back();
        attribute.key = trimmed(take(length));
        rest_.remove_prefix(1);
        take(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
        const auto text = value("] \t\r\n");
        if (!text) return text.error();
        attribute.value = *text;
    }
    rest_.remove_prefix(1);
    return std::optional(entry);
}

Result<std::optional<GodotEntry>> GodotText::property() {
    GodotEntry entry{.line = line_};
    const char* const first = rest_.data();
    if (rest_.front() == '"') {  // a name with blanks
        if (auto status = skip_string(); !status) return status.error();
    }
    const size_t length = rest_.find_first_of("=\n");
    if (length == std::string_view::npos || rest_[length] != '=') {
        return godot_error(entry.line, str_cat(quoted_text(rest_.substr(0, length)),
                                               " is neither a heading nor a property"));
    }
    take(length);
    entry.name = trimmed({first, static_cast<size_t>(rest_.data() - first)});
    rest_.remove_prefix(1);
    const auto text = value("\n");
    if (!text) return text.error();
    entry.value = *text;
    return std::optional(entry);
}

Result<std::optional<GodotEntry>> GodotText::next() {
    skip_space();
    if (rest_.empty()) return std::optional<GodotEntry>();
    return rest_.front() == '[' ? heading() : property();
}

std::optional<std::string> parse_godot_string(std::string_view value) {
    if (value.size() < 2 || value.front() != '"' || value.back() != '"') return std::nullopt;
    const std::string_view inside = value.substr(1, value.size() - 2);
    std::string text;
    for (size_t i = 0; i < inside.size();) {
        if (inside[i] == '"') return std::nullopt;
        if (inside[i] != '\\') {
            text += inside[i++];
            continue;
        }
        const size_t length = append_escape(inside.substr(i + 1), text);
        if (length == 0) return std::nullopt;
        i += length + 1;
    }
    return text;
}

Result<glm::dmat4> parse_godot_transform(std::string_view value) {
    constexpr std::string_view kType = "Transform3D";
    const auto wrong = [&](std::string_view reason) {
        return Error{ErrorCode::Corrupt, "transform", std::string(value.substr(0, 60)),
                     str_cat("transform ", reason, " (", quoted_text(value), ")")};
    };
    std::string_view list = value;
    if (!list.starts_with(kType)) return wrong("is not a Transform3D");
    list = trimmed(list.substr(kType.size()));
    if (!list.starts_with('(') || !list.ends_with(')')) return wrong("is not a Transform3D");
    list = list.substr(1, list.size() - 2);
    std::array<double, 12> numbers{};
    for (size_t i = 0; i < numbers.size(); ++i) {
        const size_t length = list.find(',');
        const bool is_last = i + 1 == numbers.size();
        if (is_last != (length == std::string_view::npos)) return wrong("does not have 12 numbers");
        const auto number =
            parse_number(trimmed(list.substr(0, length)), str_cat("transform: number ", i));
        if (!number) return number.error();
        numbers[i] = *number;
        list.remove_prefix(is_last ? list.size() : length + 1);
    }
    glm::dmat4 transform(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            transform[column][row] = numbers[static_cast<size_t>(row * 3 + column)];
        transform[3][row] = numbers[static_cast<size_t>(9 + row)];
    }
    return transform;
}

}  // namespace tetralight::detail
