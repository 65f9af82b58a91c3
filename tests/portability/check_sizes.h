// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tetralight::portability {

/// Checks that sizes which wrap around in 32 bits are refused: of sections, of layers, of strides.
/// `file`: a probe volume. Returns what was accepted; empty if nothing was.
[[nodiscard]] std::string check_sizes(std::span<const std::byte> file);

}  // namespace tetralight::portability
