// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tetralight::detail {

/// True if a Radiance .hdr file holds all its scan lines. (stb_image returns black pixels for
/// missing ones.)
[[nodiscard]] bool has_all_scan_lines(std::span<const std::byte> file, uint32_t width,
                                      uint32_t height);

}  // namespace tetralight::detail
