// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/base/process/descriptor.h>

namespace tetralight::server {

/// Which file is at a path, and when it changed.
struct FileStamp {
    uint64_t device = 0;
    uint64_t number = 0;
    uint64_t bytes = 0;
    int64_t written = 0;  ///< nanoseconds since 1970; programs can set it
    int64_t changed = 0;  ///< the same of its bytes, links, owner or rights

    bool operator==(const FileStamp&) const = default;

    /// True if both are the same file, of the same size and time of writing.
    [[nodiscard]] bool has_same_bytes(const FileStamp& other) const;
};

/// Nothing if there is no file or it cannot be reached.
[[nodiscard]] std::optional<FileStamp> stamp_of(const std::string& path);
[[nodiscard]] std::optional<FileStamp> stamp_of(const Descriptor& file);

}  // namespace tetralight::server
