// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::server {

/// What was stored or brought back.
struct BackupReport {
    uint64_t files = 0;
    uint64_t bytes = 0;
    /// Files that the database names and that could not be stored, with the reason.
    std::vector<std::string> missing;
};

/// Writes the data folder of a server, which may run, to one tar archive: a copy of the database of
/// one moment, the files that it names, the unfinished bakes and the quarantine.
[[nodiscard]] Result<BackupReport> back_up(const std::string& data, const std::string& archive);

/// Brings a data folder back. It must not exist, or be empty; it appears when all of it is written
/// and the bytes of every stored file have its id. Returns corrupt if the archive is damaged, or
/// holds what `back_up` does not write.
[[nodiscard]] Result<BackupReport> restore(const std::string& archive, const std::string& data);

}  // namespace tetralight::server
