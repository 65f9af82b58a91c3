// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

/// Reads a whole file. Errors name the path and the system's reason.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::string& path);

/// Writes `parts` one after the other to a new file beside `path`, syncs it, then renames it over
/// `path`: after a failure the old file is whole and no partial file remains. `-` (stdout) and
/// devices are written to directly.
[[nodiscard]] Status write_file(const std::string& path,
                                std::span<const std::span<const std::byte>> parts);

[[nodiscard]] Status write_file(const std::string& path, std::span<const std::byte> bytes);

/// Read-only bytes of a file, mapped into memory for as long as this object lives.
class MappedFile {
  public:
    [[nodiscard]] static Result<MappedFile> open(const std::string& path);

    /// A copy of the bytes of a file that is in memory, aligned to 64 bytes. Returns
    /// out_of_resources if there is no memory for it.
    [[nodiscard]] static Result<MappedFile> copy_of(std::span<const std::byte> bytes);

    /// Holds no bytes.
    MappedFile() = default;
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

    /// Gives back the memory of pages that were read; the next read of one maps it again. May run
    /// beside readers. Does nothing for a copy.
    void release_pages() const noexcept;

  private:
    explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::span<const std::byte> bytes_;
    bool is_copy_ = false;
};

}  // namespace tetralight
