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

/// Volumes that were requested, mapped and verified. A volume stays usable for as long as a request
/// holds it, even if it is renamed or deleted. Thread-safe.
class OpenVolumes {
  public:
    /// Keeps a reference.
    explicit OpenVolumes(Store& store) : store_(store) {}

    /// By id or by name. Throws a `Problem`: 404 if there is none; 410 if it is damaged, and moves
    /// it to the quarantine; 503 if it cannot be read for now.
    [[nodiscard]] std::shared_ptr<const ProbeFile> open(const std::string& reference);

    void forget(const std::string& id);

    [[nodiscard]] size_t count() const;

  private:
    struct Entry {
        std::string id;
        std::shared_ptr<const ProbeFile> file;
    };

    /// The system limits the number of maps.
    static constexpr size_t kMostOpen = 4096;

    Store& store_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< most recently used first
    std::map<std::string, std::list<Entry>::iterator> by_id_;
};

}  // namespace tetralight::server
