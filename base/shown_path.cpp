// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/shown_path.h>

#include <tetralight/base/hex.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

/// Bytes of each end that stay of a long path. A message of the C API has room for it and a reason.
constexpr size_t kEnd = 140;

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u;
}

std::string without_middle(const std::string& path) {
    if (path.size() <= 2 * kEnd) return path;
    size_t first = kEnd, last = path.size() - kEnd;
    while (first > 0 && continues_character(path[first])) --first;
    while (last < path.size() && continues_character(path[last])) ++last;
    return path.substr(0, first) + "..." + path.substr(last);
}

}  // namespace

std::string shown_path(std::string_view path) {
    if (path.empty()) return "\"\"";
    const bool is_text = is_utf8(path);
    std::string shown;
    for (const char character : path) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte >= 0x20 && byte != 0x7f && (byte < 0x80 || is_text)) {
            shown += character;
        } else {
            shown += {'\\', 'x', kHexDigits[byte >> 4u], kHexDigits[byte & 15u]};
        }
    }
    return without_middle(shown);
}

}  // namespace tetralight
