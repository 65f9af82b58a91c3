// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::server {

/// What was stored or brought back.
struct BackupReport {
    uint64_t files = 0;
    uint64_t bytes = 0;
    /// Files that belong to the folder and are not there, each with the reason.
    std::vector<std::string> missing;
    /// Files that are there, with wrong bytes, each with the reason.
    std::vector<std::string> damaged;
};

/// Asked between pieces of work; true ends it with the error cancelled, and nothing remains.
using IsCancelled = std::function<bool()>;

/// Writes the data folder of a server, which may run, to one tar archive: the files that the
/// database names, the unfinished bakes, the quarantine, a copy of the database of one moment and a
/// list of all with their SHA-256. Files that are missing or damaged do not stop it. The archive
/// must not lie in the folder.
[[nodiscard]] Result<BackupReport> back_up(const std::string& data, const std::string& archive,
                                           const IsCancelled& is_cancelled);

/// Brings a data folder back. It must not exist, or be empty, and appears when all of it is written
/// and checked. Stored files whose bytes do not have their id come into its quarantine. Returns
/// corrupt if the archive is cut off, its database is damaged, or it holds what `back_up` does not
/// write.
[[nodiscard]] Result<BackupReport> restore(const std::string& archive, const std::string& data,
                                           const IsCancelled& is_cancelled);

}  // namespace tetralight::server
