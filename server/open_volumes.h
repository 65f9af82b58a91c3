// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <tetralight/probes/probe_file.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// Volumes that were asked for, mapped and verified. Whoever holds one keeps it, whatever becomes
/// of its name and its file. Thread-safe.
class OpenVolumes {
  public:
    /// Keeps a reference.
    explicit OpenVolumes(Store& store) : store_(store) {}

    /// By id or by name. Throws a `Problem`: there is none (404); it is damaged, and is in
    /// quarantine from now on (410).
    [[nodiscard]] std::shared_ptr<const ProbeFile> open(const std::string& reference);

    void forget(const std::string& id);

    [[nodiscard]] size_t count() const;

  private:
    struct Entry {
        std::string id;
        std::shared_ptr<const ProbeFile> file;
    };

    /// Maps are cheap, but the system has so many of them and no more.
    static constexpr size_t kMostOpen = 4096;

    Store& store_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< the one used last is first
    std::map<std::string, std::list<Entry>::iterator> by_id_;
};

}  // namespace tetralight::server
