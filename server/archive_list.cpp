// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/archive_list.h>

#include <algorithm>
#include <array>

#include <tetralight/server/json.h>
#include <tetralight/server/stored_file.h>

namespace tetralight::server {

bool belongs_to_archive(const std::string& name) {
    constexpr std::array kFiles{kDatabaseName, kIndexName, kListName};
    if (std::ranges::find(kFiles, name) != kFiles.end()) return true;
    const size_t slash = name.find('/');
    if (slash == std::string::npos) return false;
    const std::string folder = name.substr(0, slash);
    if (const auto kind = find_kind(folder)) {
        return !id_in_file_name(*kind, name.substr(slash + 1)).empty();
    }
    return folder == "bakes" || folder == "quarantine";
}

std::string text_of(const ArchiveList& list) {
    Json files = Json::array();
    for (const auto& [name, ids] : list) {
        files.push_back({{"name", name}, {"bytes", ids.bytes}, {"sha256", ids.id}});
    }
    return dump({{"files", files}}) + "\n";
}

std::optional<ArchiveList> parse_archive_list(std::span<const std::byte> bytes) {
    const Json json = object_in(bytes);
    ArchiveList list;
    try {
        for (const Json& file : json.at("files")) {
            list[file.at("name")] = {file.at("sha256"), "", file.at("bytes")};
        }
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    return list;
}

}  // namespace tetralight::server
