// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight::detail {
class NewFile;
}

namespace tetralight {

/// The bytes of a file, in pieces that follow each other.
using FilePieces = std::span<const std::span<const std::byte>>;

/// Writes a file piece by piece, and lets it appear at `path` only when it is complete:
///
///     auto writer = FileWriter::open(path);
///     if (!writer) return writer.error();
///     ... writer->write(bytes) ... return writer->commit();
///
/// Until then `path` keeps its old content. Without `commit` no file remains; on file systems with
/// unnamed files (O_TMPFILE) this holds for a killed process, too.
class FileWriter {
  public:
    /// `-` (stdout) and devices are written to directly. Returns invalid_argument if `path` is
    /// empty.
    [[nodiscard]] static Result<FileWriter> open(const std::string& path);

    FileWriter(FileWriter&& other) noexcept;
    FileWriter& operator=(FileWriter&& other) = delete;
    ~FileWriter();

    [[nodiscard]] Status write(std::span<const std::byte> bytes);

    /// Syncs the file, renames it to `path` and syncs the folder, so that it survives a power cut.
    /// Call it once, at the end.
    [[nodiscard]] Status commit();

    /// The same, but first reads the file back. Returns corrupt if it differs from `expected`, and
    /// `path` keeps its old content. stdout and devices are not read back.
    [[nodiscard]] Status commit(FilePieces expected);

  private:
    FileWriter(std::string path, std::unique_ptr<detail::NewFile> file);

    [[nodiscard]] Status compare_with(FilePieces expected) const;

    std::string path_;  ///< as messages say it
    std::unique_ptr<detail::NewFile> file_;
};

/// What `write_compared_file` allocates at most in one piece.
inline constexpr size_t kComparedBlockSize = 1 << 20;

/// Like `write_file` in file.h, but reads the file back and compares it with `pieces` before it
/// replaces an older one.
[[nodiscard]] Status write_compared_file(const std::string& path, FilePieces pieces);

/// The path that a chain of symbolic links ends at, whether it exists or not. Returns an error if
/// the links form a cycle.
[[nodiscard]] Result<std::string> follow_links(const std::string& path);

}  // namespace tetralight
