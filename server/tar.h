// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/file_writer.h>
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

/// Writes an archive, which appears when it is whole.
class TarWriter {
  public:
    [[nodiscard]] static Result<TarWriter> open(const std::string& path);

    /// Appends the file at `path`, which may grow meanwhile: what it held at first is stored.
    /// Returns not_found if there is none; the archive is as before then.
    [[nodiscard]] Status add(const std::string& name, const std::string& path);

    [[nodiscard]] Status commit();

  private:
    explicit TarWriter(FileWriter writer) : writer_(std::move(writer)) {}

    FileWriter writer_;
};

/// Reads an archive from its begin to its end.
class TarReader {
  public:
    [[nodiscard]] static Result<TarReader> open(const std::string& path);

    /// The next file; nothing after the last one. Returns corrupt if the archive is damaged, cut
    /// off, or holds anything but files whose names stay below a folder: links, devices, absolute
    /// names and ".." are refused.
    [[nodiscard]] Result<std::optional<TarEntry>> next();

    /// The next bytes of the file; empty at its end.
    [[nodiscard]] Result<std::span<const std::byte>> read(std::span<std::byte> memory);

  private:
    TarReader(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

    [[nodiscard]] Error corrupt(const std::string& reason) const;
    [[nodiscard]] Status fill(std::span<std::byte> memory);

    std::string path_;
    Descriptor file_;
    uint64_t left_ = 0;     ///< bytes of the file that were not read yet
    uint64_t padding_ = 0;  ///< bytes after it
};

}  // namespace tetralight::server
