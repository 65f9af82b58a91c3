// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/amounts.h>

#include <cstdio>

namespace tetralight::cli {

std::optional<PlaceRange> place_range(const Values& values, std::string_view name) {
    const auto* range = values.find(name);
    if (range == nullptr) return std::nullopt;
    return PlaceRange{range->at(0).get<uint32_t>(), range->at(1).get<uint32_t>(),
                      range->at(2).get<uint32_t>()};
}

std::string percent(double fraction) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, fraction < 0.1 ? "%.2f %%" : "%.1f %%", 100.0 * fraction);
    return buffer;
}

std::string joined(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
    return line;
}

}  // namespace tetralight::cli
