// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/text_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight::detail {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// The first line that is not UTF-8, from 1; 0 if all are.
size_t first_line_not_utf8(std::string_view text) {
    if (is_utf8(text)) return 0;
    for (size_t line = 1; !text.empty(); ++line) {
        const std::string_view bytes = text.substr(0, text.find('\n'));
        if (!is_utf8(bytes)) return line;
        text.remove_prefix(std::min(text.size(), bytes.size() + 1));
    }
    return 0;
}

Error number_error(std::string_view text, std::string_view name, std::string_view reason) {
    return {ErrorCode::Corrupt, std::string(name), std::string(text.substr(0, 60)),
            str_cat(name, " is not ", reason, " (", quoted_text(text), ")")};
}

}  // namespace

Result<TextFile> TextFile::open(const std::string& path) {
    auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto bytes = file->bytes();
    if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::Unsupported,
                     str_cat(path, ": ", bytes.size(), " bytes are too many for a file of groups")};
    }
    TextFile result;
    result.text_ = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    result.file_ = std::move(*file);
    if (result.text_.starts_with(kByteOrderMark)) result.text_.remove_prefix(kByteOrderMark.size());
    if (const size_t line = first_line_not_utf8(result.text_); line != 0)
        return Error{ErrorCode::Corrupt, str_cat(path, ":", line, ": is not UTF-8")};
    return result;
}

std::string quoted_text(std::string_view text) {
    constexpr size_t kLongest = 60;
    std::string_view part = text.substr(0, kLongest);
    // Not in the middle of a character.
    while (part.size() < text.size() && !part.empty() && !is_utf8(part)) part.remove_suffix(1);
    return str_cat("\"", without_controls(part), part.size() < text.size() ? "...\"" : "\"");
}

std::string in_lower_case(std::string text) {
    for (char& letter : text) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
    return text;
}

Result<double> parse_number(std::string_view text, std::string_view name) {
    std::string_view digits = text;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    double number = 0.0;
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, number);
    if (error == std::errc::result_out_of_range && end == last)
        return number_error(text, name, "a number that doubles can hold");
    if (error != std::errc() || end != last) return number_error(text, name, "a number");
    if (!std::isfinite(number)) return number_error(text, name, "finite");
    return number;
}

Status check_group_name(std::string_view name) {
    if (name.empty())
        return Error{ErrorCode::Corrupt, "name", "", "the name of the group is empty"};
    if (name.size() <= kLongestGroupName) return Ok{};
    return Error{ErrorCode::Corrupt, "name", std::string(name.substr(0, 60)),
                 str_cat("the name of the group, ", quoted_text(name), ", is longer than ",
                         kLongestGroupName, " bytes")};
}

}  // namespace tetralight::detail
