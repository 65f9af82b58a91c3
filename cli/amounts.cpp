// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/amounts.h>

#include <charconv>
#include <cmath>
#include <cstdio>

namespace tetralight::cli {
namespace {

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || next != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Declares an option that `parse` reads, and says `form` when it cannot.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, Value& value,
                        const std::string& help, const std::string& form, Parse parse) {
    const auto read = [name, form, parse, &value](const std::string& text) {
        const auto parsed = parse(text);
        if (!parsed) throw CLI::ValidationError(name, "\"" + text + "\" is not " + form);
        value = *parsed;
    };
    return command.add_option_function<std::string>(name, read, help);
}

}  // namespace

std::optional<double> parse_share(const std::string& text) {
    const bool is_percent = text.ends_with('%');
    auto share = parse_number<double>(std::string_view(text).substr(0, text.size() - is_percent));
    if (share && is_percent) *share /= 100.0;
    if (!share || !(*share > 0.0 && *share <= 1.0)) return std::nullopt;
    return share;
}

std::optional<double> parse_time(const std::string& text) {
    std::string_view number = text;
    double unit = 1.0;
    if (!number.empty() && std::string_view("smh").find(number.back()) != std::string_view::npos) {
        unit = number.back() == 's' ? 1.0 : number.back() == 'm' ? 60.0 : 3600.0;
        number.remove_suffix(1);
    }
    const auto amount = parse_number<double>(number);
    if (!amount || !(*amount > 0.0 && *amount * unit < 1e9)) return std::nullopt;
    return *amount * unit;
}

std::optional<IndexRange> parse_range(const std::string& text) {
    const size_t dots = text.find("..");
    if (dots == std::string::npos) return std::nullopt;
    IndexRange range;
    const auto begin = parse_number<uint32_t>(std::string_view(text).substr(0, dots));
    if (!begin) return std::nullopt;
    range.begin = *begin;
    if (const auto rest = std::string_view(text).substr(dots + 2); !rest.empty()) {
        const auto end = parse_number<uint32_t>(rest);
        if (!end) return std::nullopt;
        range.end = *end;
    }
    if (range.begin >= range.end) return std::nullopt;
    return range;
}

CLI::Option* add_share(CLI::App& command, const std::string& name, double& share,
                       const std::string& help) {
    return add_parsed(command, name, share, help, "a share above 0, such as 1% or 0.01",
                      parse_share)
        ->type_name("SHARE");
}

CLI::Option* add_time(CLI::App& command, const std::string& name, double& seconds,
                      const std::string& help) {
    return add_parsed(command, name, seconds, help, "a time, such as 30s, 5m or 2h", parse_time)
        ->type_name("TIME");
}

CLI::Option* add_range(CLI::App& command, const std::string& name, std::optional<IndexRange>& range,
                       const std::string& help) {
    return add_parsed(command, name, range, help, "a range, such as 0..100 or 100..", parse_range)
        ->type_name("A..B");
}

std::string percent(double share) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, share < 0.1 ? "%.2f %%" : "%.1f %%", 100.0 * share);
    return buffer;
}

std::string joined(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
    return line;
}

}  // namespace tetralight::cli
