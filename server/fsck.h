// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::server {

/// What a check of a data folder found.
struct FolderCheck {
    struct Finding {
        /// "missing", "damaged", "unreadable", "unknown"; "database" if that is damaged.
        std::string kind;
        /// Below the data folder.
        std::string path;
        std::string detail;
    };

    uint64_t files = 0;
    uint64_t bytes = 0;
    /// Files and folders in the quarantine.
    uint64_t quarantined = 0;
    std::vector<Finding> findings;
};

/// Reads the database, all stored files and the quarantine of a server, which may run, and changes
/// nothing. Every file must be there with the bytes of its id, and nothing else. If the database is
/// missing or damaged, files are held to the ids in their names. Returns not_found if the folder
/// holds nothing of a server.
[[nodiscard]] Result<FolderCheck> check_folder(const std::string& data);

}  // namespace tetralight::server
