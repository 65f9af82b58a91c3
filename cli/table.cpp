// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/table.h>

#include <algorithm>

namespace tetralight::cli {
namespace {

size_t width(const std::string& text) {
    return static_cast<size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
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

}  // namespace tetralight::cli
