// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <sys/types.h>

#include <tetralight/server/settings.h>

namespace tetralight::server {

/// Whether the data folder is still the one that the server opened. An unmounted disk leaves an
/// empty folder under the same path, and SQLite writes on into a database that was removed.
class Readiness {
  public:
    /// Remembers the folder and its database. Precondition: the store is open.
    explicit Readiness(const Settings& settings);

    /// Why requests cannot be answered; nothing if they can. Thread-safe.
    [[nodiscard]] std::optional<std::string> fault() const;

  private:
    struct Identity {
        dev_t device = 0;
        ino_t number = 0;

        bool operator==(const Identity&) const = default;
    };

    [[nodiscard]] static std::optional<Identity> identify(const std::string& path);
    [[nodiscard]] std::optional<std::string> fault_of_writer() const;

    const bool is_read_only_;
    const std::string folder_;
    const std::string database_;
    const std::string index_;
    const std::optional<Identity> folder_identity_;
    const std::optional<Identity> database_identity_;
};

}  // namespace tetralight::server
