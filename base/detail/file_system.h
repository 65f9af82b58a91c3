// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

// All that the ship set asks of an operating system about files. One source implements it:
// file_system_posix.cpp, file_system_windows.cpp, or file_system_none.cpp where there are no files.
// Paths are UTF-8 on Windows and bytes elsewhere. Errors name the path and the system's reason.

namespace tetralight::detail {

[[nodiscard]] Result<std::vector<std::byte>> read_whole_file(const std::string& path);

/// Maps a regular file into memory, to read. Empty for an empty file.
[[nodiscard]] Result<std::span<const std::byte>> map_file(const std::string& path);

/// Precondition: `bytes` come from `map_file`.
void unmap_file(std::span<const std::byte> bytes) noexcept;

/// Gives back the memory of mapped pages; they are read again where they are used.
void release_mapped_pages(std::span<const std::byte> bytes) noexcept;

/// See `follow_links` in file_writer.h.
[[nodiscard]] Result<std::string> follow_file_links(const std::string& path);

/// A file that is written beside the one that it will replace; stdout and devices are written in
/// place. Without `commit` its destructor removes the file.
class NewFile {
  public:
    NewFile() = default;
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    virtual ~NewFile() = default;

    /// False for stdout and devices, which cannot be read back.
    [[nodiscard]] virtual bool is_replacement() const noexcept = 0;

    [[nodiscard]] virtual Status write(std::span<const std::byte> bytes) = 0;

    /// Reads what was written, from the first byte on. Returns the bytes that were read: less than
    /// `memory` has at the end only.
    [[nodiscard]] virtual Status rewind() = 0;
    [[nodiscard]] virtual Result<size_t> read(std::span<std::byte> memory) = 0;

    /// Waits until the content is on the disk. Precondition: it is a replacement.
    [[nodiscard]] virtual Status sync() = 0;

    /// Closes the file. A replacement takes its place, so that this survives a power cut.
    [[nodiscard]] virtual Status commit() = 0;
};

/// `-` is stdout.
[[nodiscard]] Result<std::unique_ptr<NewFile>> open_new_file(const std::string& path);

/// What messages call the file: its path, or `stdout`.
[[nodiscard]] std::string output_name(const std::string& path);

[[nodiscard]] Error not_a_regular_file(const std::string& path, bool is_folder);

/// The size of a file as memory has it. Returns unsupported if it exceeds the address space.
[[nodiscard]] Result<size_t> size_in_memory(const std::string& path, uint64_t size);

}  // namespace tetralight::detail
