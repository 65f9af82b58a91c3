// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/detail/checked_value.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>

namespace tetralight::settings::detail {
namespace {

std::string whole_number_text(const Range& range) {
    return "a whole number from " + number_text(std::max(range.min, 0.0)) + " to " +
           number_text(std::isfinite(range.max) ? range.max : 0x1p64);
}

}  // namespace

Error invalid(std::string_view value, std::string_view message) {
    return {ErrorCode::InvalidArgument, "", std::string(value), Message(std::string(message))};
}

Error not_a(std::string_view value, std::string_view what) {
    return invalid(value, str_cat("\"", value, "\" is not ", what));
}

Result<Json> checked_number(const Setting& setting, double number, std::string_view shown) {
    const Range& range = setting.range;
    const bool is_above = range.excludes_min ? number > range.min : number >= range.min;
    if (std::isnan(number)) return not_a(shown, "a number");
    if (std::isfinite(number) && is_above && number <= range.max) return Json(number);
    const std::string allowed = range_text(range);
    if (allowed.empty()) return not_a(shown, "a finite number");
    return invalid(shown, str_cat(shown, " is not in the range ", allowed));
}

Result<Json> checked_integer(const Setting& setting, std::optional<uint64_t> number,
                             std::string_view shown) {
    const Range& range = setting.range;
    const auto value = static_cast<double>(number.value_or(0));
    if (number && value >= range.min && value <= range.max) return Json(*number);
    return not_a(shown, whole_number_text(range));
}

std::vector<std::string_view> words_of(std::string_view list) {
    std::vector<std::string_view> words;
    for_each_word(list, [&](std::string_view word) { words.push_back(word); });
    return words;
}

std::string joined(const std::vector<std::string_view>& words, std::string_view quote) {
    std::string text;
    for (const std::string_view word : words) {
        text += str_cat(text.empty() ? "" : ", ", quote, word, quote);
    }
    return text;
}

}  // namespace tetralight::settings::detail
