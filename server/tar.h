// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/result.h>

// Archives of plain files as tar(1) writes and reads them (POSIX ustar).

namespace tetralight::server {

/// One file of an archive.
struct TarEntry {
    /// Below the folder that the archive is of: "volumes/ID.probes".
    std::string name;
    uint64_t size = 0;
    /// Seconds since 1970.
    int64_t time = 0;
};

/// Writes an archive, which appears when it is whole:
///
///     for each file: tar.begin(entry), tar.write(piece)...
///     tar.commit()
class TarWriter {
  public:
    [[nodiscard]] static Result<TarWriter> open(const std::string& path);

    /// True if an archive can hold a file of this name: parts of at most 100 and 155 bytes, split
    /// at a slash.
    [[nodiscard]] static bool can_hold(const std::string& name);

    /// Begins the next file. Preconditions: `can_hold(entry.name)`; the file before has all its
    /// bytes.
    [[nodiscard]] Status begin(const TarEntry& entry);

    /// Appends bytes to the file. Precondition: no more than its size in all.
    [[nodiscard]] Status write(std::span<const std::byte> bytes);

    /// Precondition: the last file has all its bytes.
    [[nodiscard]] Status commit();

  private:
    explicit TarWriter(FileWriter writer) : writer_(std::move(writer)) {}

    FileWriter writer_;
    uint64_t left_ = 0;     ///< bytes of the file that were not written yet
    uint64_t padding_ = 0;  ///< bytes after it
};

/// Reads an archive from its begin to its end.
class TarReader {
  public:
    /// Opens a regular file, or for `-` stdin.
    [[nodiscard]] static Result<TarReader> open(const std::string& path);

    /// Called before each read, also while stdin has no bytes; true ends the reading with the error
    /// cancelled.
    void set_stop(std::function<bool()> is_stopped) { is_stopped_ = std::move(is_stopped); }

    /// The next file; nothing after the last one. Returns corrupt if the archive is damaged, cut
    /// off, followed by anything but zeros, or holds anything but files whose names stay below a
    /// folder: links, devices, absolute names and ".." are refused.
    [[nodiscard]] Result<std::optional<TarEntry>> next();

    /// The next bytes of the file; empty at its end.
    [[nodiscard]] Result<std::span<const std::byte>> read(std::span<std::byte> memory);

  private:
    TarReader(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

    [[nodiscard]] Error corrupt(const std::string& reason) const;
    [[nodiscard]] Status wait() const;
    [[nodiscard]] Result<size_t> read_some(std::span<std::byte> memory);
    [[nodiscard]] Status fill(std::span<std::byte> memory);
    [[nodiscard]] Status skip_padding();
    [[nodiscard]] Status check_end();

    std::string path_;
    Descriptor file_;
    std::function<bool()> is_stopped_ = [] { return false; };
    uint64_t offset_ = 0;
    uint64_t left_ = 0;     ///< bytes of the file that were not read yet
    uint64_t padding_ = 0;  ///< bytes after it
};

}  // namespace tetralight::server
