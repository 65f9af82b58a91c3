// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Writes a file piece by piece, and lets it appear at `path` only when all of it is there:
///
///     auto writer = FileWriter::open(path);
///     if (!writer) return writer.error();
///     ... writer->write(bytes) ... return writer->commit();
///
/// Until then `path` keeps what it held. Without `commit` nothing is left behind; where the file
/// system has unnamed files (O_TMPFILE) that holds for a killed process, too.
class FileWriter {
  public:
    /// `-` (stdout, as messages call it) and devices are written to as they are.
    [[nodiscard]] static Result<FileWriter> open(const std::string& path);

    FileWriter(FileWriter&& other) noexcept = default;
    FileWriter& operator=(FileWriter&& other) = delete;
    ~FileWriter();

    [[nodiscard]] Status write(std::span<const std::byte> bytes);

    /// Syncs the file and puts it in its place. To be called once, at the end.
    [[nodiscard]] Status commit();

  private:
    explicit FileWriter(const std::string& path) : path_(path == "-" ? "stdout" : path) {}

    bool open_beside();
    bool move_into_place();
    bool give_name();

    std::string path_;       ///< as messages say it
    std::string target_;     ///< what is replaced; empty: written to in place
    std::string temporary_;  ///< beside the target; empty: the file has no name yet
    Descriptor file_;
};

/// The path that a chain of symbolic links ends at, there or not. Errors: the links lead in a
/// circle.
[[nodiscard]] Result<std::string> follow_links(const std::string& path);

}  // namespace tetralight
