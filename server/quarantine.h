// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/server/stored_file.h>

namespace tetralight::server {

/// A file or folder in the quarantine.
struct Quarantined {
    /// Its name there: "volumes-ID.probes".
    std::string name;
    uint64_t bytes = 0;
    /// When its bytes were written, in seconds since 1970.
    double time = 0.0;
    /// What it was stored as; nothing for what the server cannot take back: databases, bakes and
    /// unknown names.
    std::optional<Kind> kind = {};
    std::string id = {};
};

/// All that is in a quarantine, by name. Throws a `Problem`.
[[nodiscard]] std::vector<Quarantined> list_quarantine(const std::string& folder);

/// The entry of a name; nothing if there is none. Throws a `Problem`.
[[nodiscard]] std::optional<Quarantined> find_quarantined(const std::string& folder,
                                                          const std::string& name);

}  // namespace tetralight::server
