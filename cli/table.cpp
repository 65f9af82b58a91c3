// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/table.h>

#include <algorithm>

#include <tetralight/settings/setting.h>

namespace tetralight::cli {
namespace {

constexpr size_t kWidth = 96;

/// True if a UTF-8 character begins with this byte.
bool begins_character(char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
}

size_t width(std::string_view text) {
    return static_cast<size_t>(std::ranges::count_if(text, begins_character));
}

}  // namespace

std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::string& alignment) {
    std::vector<size_t> widths(alignment.size(), 0);
    for (const auto& row : rows) {
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
    }
    std::string lines;
    for (const auto& row : rows) {
        std::string line;
        for (size_t i = 0; i < row.size(); ++i) {
            const std::string gap(widths[i] - width(row[i]), ' ');
            line += "  " + (alignment[i] == 'r' ? gap + row[i] : row[i] + gap);
        }
        lines += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
    }
    return lines;
}

void append_wrapped(std::string& text, std::string_view words, size_t indent) {
    size_t column = width(std::string_view(text).substr(text.rfind('\n') + 1));
    settings::for_each_word(words, [&](std::string_view word) {
        const bool is_first = column <= indent;
        if (!is_first && column + 1 + width(word) > kWidth) {
            text += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            text += ' ';
            ++column;
        }
        text += word;
        column += width(word);
    });
    text += '\n';
}

std::string shortened(const std::string& text, size_t longest) {
    if (width(text) <= longest) return text;
    size_t count = 0;
    const auto end = std::ranges::find_if(
        text, [&](char c) { return begins_character(c) && ++count == longest; });
    return std::string(text.begin(), end) + "…";
}

}  // namespace tetralight::cli
