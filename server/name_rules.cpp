// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/name_rules.h>

#include <algorithm>
#include <span>

namespace tetralight::server {
namespace {

struct CodeRange {
    char32_t first;
    char32_t last;
};

/// White_Space of Unicode 15 beyond the controls of ASCII, with the braille pattern without dots
/// and the Hangul fillers, which are shown as blanks.
constexpr CodeRange kSpaces[] = {{0x20, 0x20},     {0xa0, 0xa0},     {0x115f, 0x1160},
                                 {0x1680, 0x1680}, {0x2000, 0x200a}, {0x202f, 0x202f},
                                 {0x205f, 0x205f}, {0x2800, 0x2800}, {0x3000, 0x3000},
                                 {0x3164, 0x3164}, {0xffa0, 0xffa0}};

/// C1 controls, Default_Ignorable_Code_Point of Unicode 15 but variation selectors, and line and
/// paragraph separators.
constexpr CodeRange kHidden[] = {{0x80, 0x9f},       {0xad, 0xad},       {0x34f, 0x34f},
                                 {0x61c, 0x61c},     {0x17b4, 0x17b5},   {0x180e, 0x180e},
                                 {0x200b, 0x200f},   {0x2028, 0x202e},   {0x2060, 0x206f},
                                 {0xfeff, 0xfeff},   {0xfff0, 0xfffb},   {0x1bca0, 0x1bca3},
                                 {0x1d173, 0x1d17a}, {0xe0000, 0xe00ff}, {0xe01f0, 0xe0fff}};

bool is_in(std::span<const CodeRange> ranges, char32_t code) noexcept {
    return std::ranges::any_of(
        ranges, [&](const CodeRange& r) { return code >= r.first && code <= r.last; });
}

/// Takes the first character off valid UTF-8.
char32_t take_character(std::string_view& text) noexcept {
    const auto lead = static_cast<unsigned char>(text.front());
    const size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    char32_t code = length == 1 ? lead : lead & (0x7fu >> length);
    for (size_t i = 1; i < length && i < text.size(); ++i) {
        code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3fu);
    }
    text.remove_prefix(std::min(length, text.size()));
    return code;
}

}  // namespace

bool has_outer_space(std::string_view utf8) noexcept {
    bool is_space = false;
    for (bool is_first = true; !utf8.empty(); is_first = false) {
        is_space = is_in(kSpaces, take_character(utf8));
        if (is_first && is_space) return true;
    }
    return is_space;
}

bool has_hidden_character(std::string_view utf8) noexcept {
    while (!utf8.empty()) {
        if (is_in(kHidden, take_character(utf8))) return true;
    }
    return false;
}

}  // namespace tetralight::server
