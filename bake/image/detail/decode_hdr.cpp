// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_hdr.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/detail/starts_with.h>
#include <tetralight/base/str_cat.h>

// The format: Greg Ward, "Real Pixels", Graphics Gems II, and "The RADIANCE Picture File Format".

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

/// Mantissas of red, green and blue, and their common exponent.
using Rgbe = std::array<uint8_t, 4>;

/// Narrower and wider lines are never encoded in the new way.
constexpr size_t kMinNewWidth = 8;
constexpr size_t kMaxNewWidth = 32767;

uint8_t byte_at(Bytes bytes, size_t offset) {
    return std::to_integer<uint8_t>(bytes[offset]);
}

/// Removes a line from the front of `rest`; nothing if no line ends.
std::optional<std::string_view> take_line(Bytes& rest) {
    const std::string_view text(reinterpret_cast<const char*>(rest.data()), rest.size());
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    rest = rest.subspan(end + 1);
    return text.substr(0, end);
}

/// Removes the lines up to the empty one.
Status skip_variables(Bytes& rest) {
    constexpr std::string_view kFormat = "FORMAT=";
    while (const auto line = take_line(rest)) {
        if (line->empty()) return Ok{};
        if (!line->starts_with(kFormat)) continue;
        const std::string_view format = line->substr(kFormat.size());
        if (format == "32-bit_rle_rgbe") continue;
        if (format == "32-bit_rle_xyze") {
            return Error{ErrorCode::Unsupported,
                         "colours as XYZ (FORMAT=32-bit_rle_xyze) are not supported, only RGB"};
        }
        return Error{ErrorCode::Unsupported, "FORMAT is not 32-bit_rle_rgbe"};
    }
    return decode_error("the header is cut off");
}

std::string_view take_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    return word;
}

std::optional<uint64_t> number_from(std::string_view word) {
    uint64_t number = 0;
    const char* end = word.data() + word.size();
    const auto [stop, problem] = std::from_chars(word.data(), end, number);
    if (problem != std::errc() || stop != end) return std::nullopt;
    return number;
}

bool is_axis(std::string_view word) {
    return word == "+X" || word == "-X" || word == "+Y" || word == "-Y";
}

/// The line with the resolution: "-Y HEIGHT +X WIDTH".
Result<ImageSize> size_from(std::string_view line) {
    const std::string_view first_axis = take_word(line);
    const auto height = number_from(take_word(line));
    const std::string_view second_axis = take_word(line);
    const auto width = number_from(take_word(line));
    if (!is_axis(first_axis) || !is_axis(second_axis) || !height || !width ||
        !take_word(line).empty()) {
        return decode_error("the line with the resolution is wrong");
    }
    if (first_axis != "-Y" || second_axis != "+X") {
        return Error{ErrorCode::Unsupported,
                     str_cat("orientation ", first_axis, " ", second_axis,
                             " is not supported, only -Y +X (top row first)")};
    }
    return checked_image_size(*width, *height);
}

/// Removes the header from the front of `rest`.
Result<ImageSize> take_header(Bytes& rest) {
    if (const auto status = skip_variables(rest); !status) return status.error();
    const auto line = take_line(rest);
    if (!line) return decode_error("the header is cut off");
    return size_from(*line);
}

/// Removes one channel of a line from the front of `rest`. A code above 128 is followed by one byte
/// that is repeated code − 128 times, another code by that many bytes.
bool take_channel(Bytes& rest, std::span<Rgbe> line, size_t channel) {
    for (size_t done = 0; done < line.size();) {
        if (rest.empty()) return false;
        const size_t code = byte_at(rest, 0);
        const bool is_run = code > 128;
        const size_t count = is_run ? code - 128 : code;
        const size_t byte_count = is_run ? 1 : count;
        if (count == 0 || count > line.size() - done || rest.size() < 1 + byte_count) return false;
        for (size_t i = 0; i < count; ++i) {
            line[done + i][channel] = byte_at(rest, is_run ? 1 : 1 + i);
        }
        rest = rest.subspan(1 + byte_count);
        done += count;
    }
    return true;
}

bool is_new_line(Bytes rest, size_t width) {
    return width >= kMinNewWidth && width <= kMaxNewWidth && rest.size() >= 4 &&
           byte_at(rest, 0) == 2 && byte_at(rest, 1) == 2 && byte_at(rest, 2) < 128;
}

/// Removes a line that is encoded channel by channel.
bool take_new_line(Bytes& rest, std::span<Rgbe> line) {
    const size_t width = size_t{byte_at(rest, 2)} << 8 | byte_at(rest, 3);
    if (width != line.size()) return false;
    rest = rest.subspan(4);
    for (size_t channel = 0; channel < 4; ++channel) {
        if (!take_channel(rest, line, channel)) return false;
    }
    return true;
}

/// Removes a line of pixels. A pixel of mantissas 1, 1, 1 stands for repeats of the one before it,
/// as many as its exponent says; such pixels in a row are the bytes of one number, lowest first.
bool take_old_line(Bytes& rest, std::span<Rgbe> line) {
    uint32_t shift = 0;
    for (size_t done = 0; done < line.size();) {
        if (rest.size() < 4) return false;
        const Rgbe pixel = {byte_at(rest, 0), byte_at(rest, 1), byte_at(rest, 2), byte_at(rest, 3)};
        rest = rest.subspan(4);
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[done++] = pixel;
            shift = 0;
            continue;
        }
        const uint64_t count = uint64_t{pixel[3]} << shift;
        if (done == 0 || shift > 24 || count > line.size() - done) return false;
        const Rgbe repeated = line[done - 1];
        std::fill_n(line.begin() + static_cast<ptrdiff_t>(done), count, repeated);
        done += count;
        shift += 8;
    }
    return true;
}

/// value = mantissa / 256 · 2^(exponent − 128); exponent 0 is black.
glm::vec3 color_from(const Rgbe& pixel) {
    if (pixel[3] == 0) return glm::vec3(0.0f);
    const float scale = std::ldexp(1.0f, pixel[3] - (128 + 8));
    return glm::vec3(pixel[0], pixel[1], pixel[2]) * scale;
}

Error line_error(uint32_t row, uint32_t height) {
    return decode_error(str_cat("scan line ", row, " of ", height, " is cut off or damaged"));
}

}  // namespace

bool is_hdr(Bytes bytes) {
    return starts_with(bytes, "#?");
}

Result<ImageSize> read_hdr_size(Bytes bytes) {
    return take_header(bytes);
}

Result<ImageF> decode_hdr(Bytes bytes) {
    const auto size = take_header(bytes);
    if (!size) return size.error();
    // So that a short file does not make a large image: a line has 4 bytes or more.
    const size_t most_lines = bytes.size() / 4;
    if (size->height > most_lines) {
        return line_error(static_cast<uint32_t>(most_lines), size->height);
    }
    ImageF image{size->width, size->height, {}};
    image.pixels.resize(size_t{size->width} * size->height);
    std::vector<Rgbe> line(size->width);
    for (uint32_t row = 0; row < size->height; ++row) {
        const bool is_whole = is_new_line(bytes, line.size()) ? take_new_line(bytes, line)
                                                              : take_old_line(bytes, line);
        if (!is_whole) return line_error(row, size->height);
        std::ranges::transform(line, image.pixels.begin() + size_t{row} * size->width, color_from);
    }
    return image;
}

}  // namespace tetralight::detail
