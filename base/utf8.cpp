// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/utf8.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <tetralight/base/hex.h>

namespace tetralight {
namespace {

bool is_in(char byte, int low, int high) {
    const int value = static_cast<unsigned char>(byte);
    return value >= low && value <= high;
}

/// Length of the character at the beginning; 0 if it is not valid UTF-8. Precondition: not empty.
size_t character_length(std::string_view bytes) {
    const char lead = bytes[0];
    if (is_in(lead, 0x00, 0x7f)) return 1;
    const size_t length = is_in(lead, 0xc2, 0xdf)   ? 2
                          : is_in(lead, 0xe0, 0xef) ? 3
                          : is_in(lead, 0xf0, 0xf4) ? 4
                                                    : 0;
    if (length == 0 || bytes.size() < length) return 0;
    // Some lead bytes limit the second one: no overlong forms, surrogates, or beyond U+10FFFF.
    const int low = lead == '\xe0' ? 0xa0 : lead == '\xf0' ? 0x90 : 0x80;
    const int high = lead == '\xed' ? 0x9f : lead == '\xf4' ? 0x8f : 0xbf;
    if (!is_in(bytes[1], low, high)) return 0;
    for (size_t i = 2; i < length; ++i) {
        if (!is_in(bytes[i], 0x80, 0xbf)) return 0;
    }
    return length;
}

/// Bytes of the control character at the beginning; 0 if there is none. Precondition: not empty.
size_t control_length(std::string_view text) {
    if (is_in(text[0], 0x00, 0x1f) || is_in(text[0], 0x7f, 0x7f)) return 1;
    return text[0] == '\xc2' && text.size() > 1 && is_in(text[1], 0x80, 0x9f) ? 2 : 0;
}

/// Bytes of the mark of direction at the beginning; 0 if there is none. Precondition: not empty.
size_t direction_mark_length(std::string_view text) {
    if (text.size() < 3 || text[0] != '\xe2') return 0;
    const bool is_mark = (text[1] == '\x80' && (is_in(text[2], 0x8e, 0x8f) ||  //
                                                is_in(text[2], 0xaa, 0xae))) ||
                         (text[1] == '\x81' && is_in(text[2], 0xa6, 0xa9));
    return is_mark ? 3 : 0;
}

/// `\u202e`. Precondition: one character of at most three bytes.
std::string escape_of(std::string_view character) {
    uint32_t code = static_cast<unsigned char>(character[0]);
    if (character.size() == 2) code &= 0x1fu;
    if (character.size() == 3) code &= 0x0fu;
    for (const char byte : character.substr(1)) {
        code = code << 6u | (static_cast<unsigned char>(byte) & 0x3fu);
    }
    return "\\u" + hex(code, 4);
}

}  // namespace

bool is_utf8(std::string_view bytes) noexcept {
    while (!bytes.empty()) {
        const size_t length = character_length(bytes);
        if (length == 0) return false;
        bytes.remove_prefix(length);
    }
    return true;
}

bool has_control_character(std::string_view text) noexcept {
    for (size_t i = 0; i < text.size(); ++i) {
        if (control_length(text.substr(i)) > 0) return true;
    }
    return false;
}

std::string without_controls(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        const size_t length = std::max(control_length(text), direction_mark_length(text));
        if (length == 0)
            shown += text[0];
        else
            shown += escape_of(text.substr(0, length));
        text.remove_prefix(std::max(length, size_t{1}));
    }
    return shown;
}

std::string with_blanks_for_controls(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const size_t length = control_length(text);
        clean += length == 0 ? text[0] : ' ';
        text.remove_prefix(std::max(length, size_t{1}));
    }
    return clean;
}

Status check_characters(std::string_view name) {
    if (has_control_character(name)) {
        return Error{ErrorCode::InvalidArgument, "name", "",
                     "the name holds a line break or another control character"};
    }
    if (!is_utf8(name))
        return Error{ErrorCode::InvalidArgument, "name", "", "the name is not UTF-8"};
    return Ok{};
}

}  // namespace tetralight
