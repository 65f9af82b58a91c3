// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/store_index.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

/// Indexes of early versions have one "name" instead of "names".
std::set<std::string> names_of(const Json& entry) {
    if (entry.contains("names")) return entry["names"];
    const std::string name = entry.at("name");
    return name.empty() ? std::set<std::string>() : std::set{name};
}

/// False for numbers that would be converted to others (-1 bytes are 1.8e19), and for facts that
/// are no object.
bool has_right_types(const Json& entry) {
    return entry.at("bytes").is_number_unsigned() && entry.at("created").is_number() &&
           entry.at("facts").is_object();
}

StoredFile read_entry(Kind kind, const Json& entry) {
    return {.kind = kind,
            .id = entry.at("id"),
            .names = names_of(entry),
            .bytes = entry.at("bytes"),
            .created = entry.at("created"),
            .facts = dump(entry.at("facts")),
            .damage = entry.value("damage", "")};
}

}  // namespace

StoreIndex parse_store_index(std::span<const std::byte> bytes) {
    const Json json = object_in(bytes);
    StoreIndex index;
    if (!json.contains("files") || !json["files"].is_array()) return index;
    index.is_whole = true;
    for (const Json& entry : json["files"]) {
        try {
            const auto kind = find_kind(entry.at("kind"));
            if (!kind) continue;  // of a later version
            StoredFile file = read_entry(*kind, entry);
            const bool is_right = is_id(file.id) && has_right_types(entry);
            index.is_whole &= is_right;
            if (!is_right) continue;
            const std::string key = str_cat(name_of(*kind), "/", file.id);
            index.is_whole &= index.files.try_emplace(key, std::move(file)).second;
        } catch (const Json::exception&) {
            index.is_whole = false;
        }
    }
    return index;
}

Json index_entry(const StoredFile& file) {
    Json entry = to_json(file);
    entry["kind"] = name_of(file.kind);
    entry["facts"] = object_in(file.facts);
    return entry;
}

std::string index_text(const Json& entries) {
    return dump({{"files", entries}});
}

}  // namespace tetralight::server
