// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

#include <tetralight/server/file_ids.h>

// What an archive of a data folder holds: the files below, and their list at its end.

namespace tetralight::server {

inline constexpr const char* kDatabaseName = "tetralight.db";
inline constexpr const char* kIndexName = "index.json";
inline constexpr const char* kListName = "backup.json";

/// Files of an archive by their names, with the ids of their bytes.
using ArchiveList = std::map<std::string, FileIds>;

/// True for "tetralight.db", "volumes/ID.probes", "bakes/..." and all else that a backup stores.
[[nodiscard]] bool belongs_to_archive(const std::string& name);

/// The bytes of `backup.json`.
[[nodiscard]] std::string text_of(const ArchiveList& list);

/// Reads `backup.json`; nothing if it is damaged. The old ids are empty.
[[nodiscard]] std::optional<ArchiveList> parse_archive_list(std::span<const std::byte> bytes);

}  // namespace tetralight::server
