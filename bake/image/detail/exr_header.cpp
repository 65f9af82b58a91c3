// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/exr_header.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include <tetralight/bake/image/detail/image_size.h>

// The layout: "OpenEXR File Layout".

namespace tetralight::detail {
namespace {

/// Removes a text that ends with a zero from the front of `rest`.
std::optional<std::string_view> take_text(std::span<const std::byte>& rest) {
    const std::string_view text(reinterpret_cast<const char*>(rest.data()), rest.size());
    const size_t end = text.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    rest = rest.subspan(end + 1);
    return text.substr(0, end);
}

Error cut_off_error() {
    return decode_error("the header is cut off or damaged");
}

/// From the smallest x and y and the largest ones, all inclusive.
Result<ImageSize> size_from(const std::array<int32_t, 4>& window) {
    const int64_t width = int64_t{window[2]} - window[0] + 1;
    const int64_t height = int64_t{window[3]} - window[1] + 1;
    return checked_image_size(static_cast<uint64_t>(std::max<int64_t>(width, 0)),
                              static_cast<uint64_t>(std::max<int64_t>(height, 0)));
}

/// Removes one header from the front of `rest`: attributes up to an empty name.
Result<ImageSize> take_exr_header(std::span<const std::byte>& rest) {
    std::optional<std::array<int32_t, 4>> window;
    while (const auto name = take_text(rest)) {
        if (name->empty()) {
            if (!window) return decode_error("the header has no dataWindow");
            return size_from(*window);
        }
        uint32_t size = 0;
        if (!take_text(rest) || rest.size() < sizeof size) return cut_off_error();
        std::memcpy(&size, rest.data(), sizeof size);
        rest = rest.subspan(sizeof size);
        if (size > rest.size()) return cut_off_error();
        if (*name == "dataWindow") {
            if (size != sizeof *window) return decode_error("dataWindow has not four numbers");
            std::memcpy(&window.emplace(), rest.data(), size);
        }
        rest = rest.subspan(size);
    }
    return cut_off_error();
}

}  // namespace

Result<ImageSize> read_exr_size(std::span<const std::byte> bytes) {
    constexpr size_t kVersionOffset = 4, kVersionEnd = 8;
    constexpr uint32_t kSeveralParts = 0x1000;
    if (bytes.size() < kVersionEnd) return cut_off_error();
    uint32_t version = 0;
    std::memcpy(&version, bytes.data() + kVersionOffset, sizeof version);
    auto rest = bytes.subspan(kVersionEnd);
    const auto first = take_exr_header(rest);
    if (!first || (version & kSeveralParts) == 0) return first;
    // An empty header ends them.
    while (!rest.empty() && rest[0] != std::byte{0}) {
        if (const auto other = take_exr_header(rest); !other) return other.error();
    }
    return first;
}

}  // namespace tetralight::detail
