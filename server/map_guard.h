// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include <tetralight/base/result.h>

namespace tetralight::server {

/// Keeps the server alive when a mapped file becomes shorter or its disk fails. The system sends
/// SIGBUS to a thread that reads such a page; the handler puts a page of zeros there and marks the
/// guard. Results that were computed meanwhile are wrong.
class MapGuard {
  public:
    /// Guards mapped bytes for as long as the guard lives. The first guard installs the handler of
    /// the process. Returns out_of_resources if there are too many.
    [[nodiscard]] static Result<MapGuard> make(std::span<const std::byte> bytes);

    MapGuard(MapGuard&& other) noexcept : slot_(std::exchange(other.slot_, kNone)) {}

    MapGuard& operator=(MapGuard&&) = delete;
    ~MapGuard();

    /// True if a page could not be read since the guard was made.
    [[nodiscard]] bool is_damaged() const;

  private:
    static constexpr size_t kNone = SIZE_MAX;

    explicit MapGuard(size_t slot) : slot_(slot) {}

    size_t slot_;
};

/// Guards everything that this thread reads for as long as it lives: for a file whose place in
/// memory is not known yet.
class ThreadGuard {
  public:
    ThreadGuard();
    ThreadGuard(const ThreadGuard&) = delete;
    ThreadGuard& operator=(const ThreadGuard&) = delete;
    ~ThreadGuard();

    [[nodiscard]] bool is_damaged() const;
};

}  // namespace tetralight::server
