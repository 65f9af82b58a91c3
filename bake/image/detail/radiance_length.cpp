// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/radiance_length.h>

#include <string_view>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

constexpr uint32_t kChannelCount = 4;
/// Narrower and wider images are never run-length encoded.
constexpr uint32_t kMinRunLengthWidth = 8;
constexpr uint32_t kMaxRunLengthWidth = 32767;

/// The bytes behind the header, which is lines, an empty line, and the line with the resolution.
Bytes scan_lines(Bytes file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const size_t header_end = text.find("\n\n");
    if (header_end == std::string_view::npos) return {};
    const size_t resolution_end = text.find('\n', header_end + 2);
    return resolution_end == std::string_view::npos ? Bytes() : file.subspan(resolution_end + 1);
}

bool starts_run_length_line(Bytes bytes) {
    return bytes.size() >= 4 && bytes[0] == std::byte{2} && bytes[1] == std::byte{2} &&
           bytes[2] < std::byte{128};
}

/// Removes one encoded channel of one line from the front of `bytes`. A code above 128 is followed
/// by one byte that is repeated code − 128 times, another code by that many bytes.
bool skip_channel(Bytes& bytes, uint32_t width) {
    for (uint32_t done = 0; done < width;) {
        if (bytes.empty()) return false;
        const auto code = std::to_integer<uint32_t>(bytes[0]);
        const bool is_run = code > 128;
        const size_t byte_count = is_run ? 2 : 1 + code;
        if (code == 0 || bytes.size() < byte_count) return false;
        bytes = bytes.subspan(byte_count);
        done += is_run ? code - 128 : code;
    }
    return true;
}

}  // namespace

bool has_all_scan_lines(Bytes file, uint32_t width, uint32_t height) {
    Bytes bytes = scan_lines(file);
    const bool is_run_length =
        width >= kMinRunLengthWidth && width <= kMaxRunLengthWidth && starts_run_length_line(bytes);
    if (!is_run_length) return bytes.size() / kChannelCount / width >= height;
    for (uint32_t row = 0; row < height; ++row) {
        if (!starts_run_length_line(bytes)) return false;
        bytes = bytes.subspan(4);
        for (uint32_t channel = 0; channel < kChannelCount; ++channel) {
            if (!skip_channel(bytes, width)) return false;
        }
    }
    return true;
}

}  // namespace tetralight::detail
