// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <tetralight/base/process/descriptor.h>

namespace tetralight {

/// Reads until `memory` is full or the file ends, across interrupted calls and short reads. Returns
/// the number of bytes read; nothing after an error, whose reason is in errno.
[[nodiscard]] std::optional<size_t> read_up_to(const Descriptor& file, std::span<std::byte> memory);

/// Writes all bytes, across interrupted calls and short writes. False after an error, whose reason
/// is in errno.
[[nodiscard]] bool write_all(const Descriptor& file, std::span<const std::byte> bytes);

/// A path that opens the file of an open descriptor of this process, also if the file has no name.
[[nodiscard]] std::string path_of_descriptor(const Descriptor& file);

}  // namespace tetralight
