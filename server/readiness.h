// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include <tetralight/server/file_stamp.h>
#include <tetralight/server/periodic.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

/// Whether the data folder is still the one that the server opened. An unmounted disk leaves an
/// empty folder under the same path, and SQLite writes on into a database that was removed. A
/// thread of its own looks four times a second, because a disk that does not answer lets its reader
/// wait for ever. Thread-safe; nothing here waits for the disk but the constructor and
/// `require_database`.
class Readiness {
  public:
    /// Remembers the folder and its database. Precondition: the store is open.
    explicit Readiness(const Settings& settings);

    /// Why requests cannot be answered; nothing if they can.
    [[nodiscard]] std::optional<std::string> fault() const;

    /// Looks at once, and throws a `Problem`, 503, if the folder or its database is not the one
    /// that was opened: what is written then is lost. Waits for the disk.
    void require_database() const;

    struct Disk {
        uint64_t free_bytes = 0;  ///< that the server may use
        uint64_t bytes = 0;
    };

    /// The disk of the data folder; nothing if it did not answer.
    [[nodiscard]] std::optional<Disk> disk() const;

  private:
    using Clock = std::chrono::steady_clock;

    struct State {
        std::optional<std::string> fault;
        std::optional<Disk> disk;
        Clock::time_point time;  ///< when the look began
    };

    [[nodiscard]] State look() const;
    [[nodiscard]] std::optional<std::string> find_fault() const;
    [[nodiscard]] std::optional<std::string> fault_of_database() const;
    [[nodiscard]] std::optional<std::string> fault_of_folders() const;

    const bool is_read_only_;
    const std::string folder_;
    const std::string database_;
    const std::string log_;  ///< the commits that are not in the database yet
    const std::string index_;
    const std::optional<FileStamp> folder_stamp_;
    const std::optional<FileStamp> database_stamp_;
    const std::optional<FileStamp> log_stamp_;
    mutable std::mutex mutex_;
    State state_;
    Periodic periodic_;
};

}  // namespace tetralight::server
