// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>

#include <tetralight/server/stored_file.h>

namespace tetralight::server {

/// index.json: what a store holds, for servers that only read and for a writer whose database is
/// damaged.
struct StoreIndex {
    /// By "kind/id".
    std::map<std::string, StoredFile> files;
    /// False if a part of it could not be read.
    bool is_whole = false;
};

/// Reads an index. Entries that are damaged are left out.
[[nodiscard]] StoreIndex parse_store_index(std::span<const std::byte> bytes);

/// One entry of the index.
[[nodiscard]] Json index_entry(const StoredFile& file);

/// The bytes of an index with these entries.
[[nodiscard]] std::string index_text(const Json& entries);

}  // namespace tetralight::server
