// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/position_text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <span>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

std::string shown(std::string_view input) {
    constexpr size_t kLongest = 40;
    return std::string(input.substr(0, kLongest)) + (input.size() > kLongest ? "..." : "");
}

Result<float> parse_coordinate(std::string_view digits, const char* name, size_t& length) {
    float number = 0.0f;
    const auto [next, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    length = static_cast<size_t>(next - digits.data());
    if (error == std::errc{}) return number;
    if (error == std::errc::invalid_argument)
        return Error{ErrorCode::InvalidArgument, "not a number"};
    const std::string taken(digits.substr(0, length));
    const double value = std::strtod(taken.c_str(), nullptr);
    if (std::abs(value) > 1.0) {
        return Error{ErrorCode::Corrupt, "position", shown(taken),
                     str_cat(name, " is ", shown(taken), ", beyond what a float holds (3.4e38)")};
    }
    return static_cast<float>(value);  // nearly 0
}

namespace {

/// A '+' before a number is ignored.
std::string_view without_plus(std::string_view digits) {
    const bool has_plus = digits.starts_with('+') && !digits.substr(1).starts_with('-');
    return has_plus ? digits.substr(1) : digits;
}

}  // namespace

Result<QueryPosition> parse_position(std::string_view line, Normals normals) {
    constexpr const char* kBlanks = " \t\r";
    std::string_view rest = line;
    const auto skip_blanks = [&] {
        const size_t before = rest.size();
        rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), before));
        return rest.size() < before;
    };
    const auto skip_gap = [&] {
        const bool has_blanks = skip_blanks();
        if (!rest.starts_with(',')) return has_blanks;
        rest.remove_prefix(1);
        skip_blanks();
        return true;
    };
    const auto not_all = [&] {
        const char* form = normals == Normals::Given ? "x y z nx ny nz" : "x y z";
        return Error{ErrorCode::Corrupt, "position", shown(line),
                     str_cat("\"", shown(line), "\" is not ", form)};
    };
    std::array<float, 6> numbers{};
    const auto used = std::span(numbers).first(static_cast<size_t>(number_count(normals)));
    skip_blanks();
    for (size_t i = 0; i < used.size(); ++i) {
        if (i > 0 && !skip_gap()) return not_all();
        rest = without_plus(rest);
        size_t length = 0;
        const auto number = parse_coordinate(rest, kNumberNames[i], length);
        if (!number) return number.error().code == ErrorCode::Corrupt ? number.error() : not_all();
        used[i] = *number;
        rest.remove_prefix(length);
    }
    skip_blanks();
    if (!rest.empty()) return not_all();
    return make_query_position(used);
}

}  // namespace tetralight::cli
