// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <tetralight/server/load_volume.h>
#include <tetralight/server/periodic.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// Volumes that were requested and verified: copies of small ones, and maps of large ones, whose
/// files are read again from time to time, and at once if they seem to have changed. A volume stays
/// usable for as long as a request holds it, even if it is renamed or deleted. Thread-safe.
class OpenVolumes {
  public:
    /// Keeps a reference.
    explicit OpenVolumes(Store& store);

    /// By id or by name. Throws a `Problem`: 404 if there is none; 410 if it is damaged, and moves
    /// it to the quarantine; 503 if it cannot be read for now.
    [[nodiscard]] std::shared_ptr<const LoadedVolume> open(const std::string& reference);

    void forget(const std::string& id);

    [[nodiscard]] size_t count() const;

  private:
    using Clock = std::chrono::steady_clock;

    struct Entry {
        std::string id;
        std::shared_ptr<const LoadedVolume> volume;
        /// When its file was last checked, and what it was when it was last looked at.
        Clock::time_point checked;
        std::optional<FileStamp> stamp = {};
        bool is_due = false;  ///< to be checked before all others
    };

    /// The system limits the number of maps.
    static constexpr size_t kMostOpen = 4096;
    /// Copies may take as much memory as this many of the largest ones.
    static constexpr uint64_t kMostCopies = 16;

    [[nodiscard]] std::shared_ptr<const LoadedVolume> find_known(const std::string& id);
    [[nodiscard]] std::shared_ptr<const LoadedVolume> find(const std::string& id);
    [[nodiscard]] std::shared_ptr<const LoadedVolume> keep(const std::string& id,
                                                           LoadedVolume volume);
    void erase_locked(std::list<Entry>::iterator entry);
    void check_oldest();
    [[nodiscard]] std::string next_to_check();
    void check(const std::string& id);
    void set_checked(const std::string& id);

    Store& store_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< most recently used first
    std::map<std::string, std::list<Entry>::iterator> by_id_;
    uint64_t copied_bytes_ = 0;
    Periodic periodic_;  ///< reads the files of mapped volumes again
};

}  // namespace tetralight::server
