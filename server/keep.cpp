// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/keep.h>

#include <charconv>
#include <string_view>

namespace tetralight::server {

bool Keep::is_over(double time, size_t newer, double now) const {
    return (count && newer >= *count) || (seconds && now - time > *seconds);
}

std::optional<Keep> parse_keep(const std::string& text) {
    const char* end = text.data() + text.size();
    uint64_t number = 0;
    const auto [next, error] = std::from_chars(text.data(), end, number);
    constexpr uint64_t kMost = 1'000'000'000;
    if (error != std::errc{} || number == 0 || number > kMost) return std::nullopt;
    const std::string_view unit(next, static_cast<size_t>(end - next));
    if (unit.empty()) return Keep{.count = number};
    constexpr std::string_view kUnits = "smhd";
    constexpr double kSeconds[] = {1.0, 60.0, 3600.0, 86400.0};
    const size_t index = kUnits.find(unit[0]);
    if (unit.size() != 1 || index == std::string_view::npos) return std::nullopt;
    return Keep{.seconds = static_cast<double>(number) * kSeconds[index]};
}

}  // namespace tetralight::server
