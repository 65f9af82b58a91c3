// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight::server {

/// The ids that the bytes of a file have, and their number.
struct FileIds {
    std::string id;
    /// The id that versions before 0.1 gave.
    std::string old_id;
    uint64_t bytes = 0;

    [[nodiscard]] bool contains(const std::string& other) const {
        return other == id || other == old_id;
    }
};

/// Reads a file once. The file is not mapped: a disk that fails or a file that shrinks is an error
/// here, not a signal.
[[nodiscard]] Result<FileIds> read_file_ids(const std::string& path);

/// Appends the bytes of a file to an open one.
[[nodiscard]] Status copy_file(const std::string& path, const Descriptor& to);

/// True if two files have the same bytes.
[[nodiscard]] Result<bool> have_same_bytes(const std::string& a, const std::string& b);

}  // namespace tetralight::server
