// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <tetralight/base/process/descriptor.h>
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

/// The ids of bytes that come in pieces.
class FileIdsHash {
  public:
    FileIdsHash();
    FileIdsHash(FileIdsHash&&) noexcept;
    FileIdsHash& operator=(FileIdsHash&&) = delete;
    ~FileIdsHash();

    void add(std::span<const std::byte> bytes);

    /// Of all bytes so far.
    [[nodiscard]] FileIds ids() const;

  private:
    struct State;

    std::unique_ptr<State> state_;
};

/// Opens a file to read. Returns an error, without waiting, if it is a pipe, a device or a folder.
[[nodiscard]] Result<Descriptor> open_regular(const std::string& path);

/// Reads a file once. The file is not mapped: a disk that fails or a file that shrinks is an error
/// here, not a signal.
[[nodiscard]] Result<FileIds> read_file_ids(const std::string& path);

/// Appends the bytes of a file to an open one.
[[nodiscard]] Status copy_file(const std::string& path, const Descriptor& to);

/// True if two files have the same bytes.
[[nodiscard]] Result<bool> have_same_bytes(const std::string& a, const std::string& b);

}  // namespace tetralight::server
