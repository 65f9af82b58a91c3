// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

// What a child process reads from and writes to.

namespace tetralight::detail {

/// The system's reason (errno) why something cannot be done: `cannot start (No such file ...)`.
[[nodiscard]] Error system_error(const std::string& what);

/// Owns a file descriptor that is none of the three standard ones, so that redirecting those in
/// the child never closes it, even in a process that began without them.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int descriptor);
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor();

    [[nodiscard]] int value() const { return descriptor_; }

    [[nodiscard]] explicit operator bool() const { return descriptor_ >= 0; }

    void close();

  private:
    int descriptor_ = -1;
};

/// A file in memory, at its beginning. A child reads of it what it likes, when it likes: unlike a
/// pipe it needs nobody at the other end.
[[nodiscard]] Result<Descriptor> make_memory_file(
    std::span<const std::span<const std::byte>> parts);

/// A stream that a child writes to and that is read here without waiting.
class OutputPipe {
  public:
    Status open();

    [[nodiscard]] int read_end() const { return read_end_.value(); }

    [[nodiscard]] int write_end() const { return write_end_.value(); }

    void close_write_end() { write_end_.close(); }

    [[nodiscard]] bool has_ended() const { return !read_end_; }

    /// Appends what is there. False when there was nothing.
    bool read(std::vector<std::byte>& bytes);

  private:
    Descriptor read_end_;
    Descriptor write_end_;
};

}  // namespace tetralight::detail
