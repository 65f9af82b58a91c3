// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/escape.h>

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// Bytes of the UTF-8 character that begins at `at`; 0 if none does.
size_t character_length(std::string_view text, size_t at) {
    for (size_t length = 1; length <= 4 && at + length <= text.size(); ++length) {
        if (is_utf8(text.substr(at, length))) return length;
    }
    return 0;
}

/// Calls `append(out, character)` for each character; each byte that is not UTF-8 counts as U+FFFD.
template <class Append>
std::string escaped(std::string_view text, Append&& append) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
        const size_t length = character_length(text, at);
        append(out, length == 0 ? kReplacement : text.substr(at, length));
        at += length == 0 ? 1 : length;
    }
    return out;
}

bool is_control(std::string_view character) {
    const auto byte = static_cast<uint8_t>(character[0]);
    const bool is_c1 =
        character.size() == 2 && byte == 0xC2 && static_cast<uint8_t>(character[1]) < 0xA0;
    return is_c1 || byte < 0x20 || byte == 0x7F;
}

/// The code of a control character in four hexadecimal digits.
std::string code_of(std::string_view character) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto code = static_cast<uint8_t>(character.back());
    return str_cat("00", kDigits[code >> 4], kDigits[code & 15]);
}

/// Between double quotes: `before` and `after` the code of a control character.
std::string quoted(std::string_view text, std::string_view before, std::string_view after) {
    return str_cat('"',
                   escaped(text,
                           [&](std::string& out, std::string_view character) {
                               if (is_control(character)) {
                                   out += str_cat(before, code_of(character), after);
                                   return;
                               }
                               if (character == "\"" || character == "\\") out += '\\';
                               out += character;
                           }),
                   '"');
}

}  // namespace

std::string quoted_for_json(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string quoted_for_godot(std::string_view text) {
    return quoted(text, "\\u", "");
}

std::string quoted_for_csharp(std::string_view text) {
    return quoted(text, "\\u", "");
}

std::string quoted_for_ron(std::string_view text) {
    return quoted(text, "\\u{", "}");
}

std::string escaped_for_xml(std::string_view text) {
    return escaped(text, [](std::string& out, std::string_view character) {
        constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kEntities{
            {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&apos;"}}};
        for (const auto& [plain, entity] : kEntities) {
            if (character == plain) {
                out += entity;
                return;
            }
        }
        const bool is_not_xml = character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
        out += is_control(character) || is_not_xml ? kReplacement : character;
    });
}

std::string escaped_for_csv(std::string_view text) {
    std::string field = escaped(text, [](std::string& out, std::string_view character) {
        if (character == "\"") out += '"';
        out += character == std::string_view("\0", 1) ? kReplacement : character;
    });
    // Spreadsheets skip blanks before a formula.
    const size_t start = field.find_first_not_of(' ');
    const bool is_formula =
        start != std::string::npos &&
        std::string_view("=+-@\t\r").find(field[start]) != std::string_view::npos;
    if (is_formula) field.insert(0, 1, '\'');
    if (field.find_first_of("\",\n\r") == std::string::npos) return field;
    return str_cat('"', field, '"');
}

}  // namespace tetralight
