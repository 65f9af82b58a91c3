// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/utf8.h>

#include <algorithm>
#include <cstddef>

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
        if (is_in(text[i], 0x00, 0x1f) || is_in(text[i], 0x7f, 0x7f)) return true;
        const bool is_c1 =
            text[i] == '\xc2' && i + 1 < text.size() && is_in(text[i + 1], 0x80, 0x9f);
        if (is_c1) return true;
    }
    return false;
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
