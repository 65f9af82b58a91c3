// SPDX-License-Identifier: Apache-2.0
#include "cli/position_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "base/text.h"

namespace tetralight::cli {

std::string shown(std::string_view input) {
    constexpr size_t kLongest = 40;
    return std::string(input.substr(0, kLongest)) + (input.size() > kLongest ? "..." : "");
}

Result<float> parse_coordinate(std::string_view digits, char axis, size_t& length) {
    float number = 0.0f;
    const auto [next, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    length = static_cast<size_t>(next - digits.data());
    if (error == std::errc{}) return number;
    if (error == std::errc::invalid_argument) return Error{};
    const std::string taken(digits.substr(0, length));
    const double value = std::strtod(taken.c_str(), nullptr);
    if (std::abs(value) > 1.0) {
        return Error{text(axis, " is ", shown(taken), ", beyond what a float holds (3.4e38)")};
    }
    return static_cast<float>(value);  // nearly 0
}

Result<glm::vec3> parse_position(std::string_view line) {
    constexpr const char* kGaps = " \t,\r";
    std::string_view rest = line;
    const auto skip_gap = [&] {
        rest.remove_prefix(std::min(rest.find_first_not_of(kGaps), rest.size()));
    };
    const auto not_three = [&] { return Error{text("\"", shown(line), "\" is not x y z")}; };
    glm::vec3 position(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        skip_gap();
        size_t length = 0;
        const auto number = parse_coordinate(rest, "xyz"[axis], length);
        if (!number) return number.error().message.empty() ? not_three() : number.error();
        position[axis] = *number;
        rest.remove_prefix(length);
    }
    skip_gap();
    if (!rest.empty()) return not_three();
    return position;
}

}  // namespace tetralight::cli
