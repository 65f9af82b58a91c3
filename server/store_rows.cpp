// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/store_rows.h>

#include <map>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {

std::vector<StoredFile> read_stored_files(Database& database) {
    std::vector<StoredFile> files;
    std::map<std::string, size_t> index_of;  // by place
    for (const auto& row : database.run(
             "SELECT id, kind, bytes, created, facts, damage FROM files ORDER BY kind, id")) {
        StoredFile file;
        file.id = std::get<std::string>(row[0]);
        file.kind = find_kind(std::get<std::string>(row[1])).value();
        file.bytes = static_cast<uint64_t>(std::get<int64_t>(row[2]));
        file.created = std::get<double>(row[3]);
        file.facts = std::get<std::string>(row[4]);
        file.damage = std::get<std::string>(row[5]);
        index_of[place_of(file)] = files.size();
        files.push_back(std::move(file));
    }
    for (const auto& row : database.run("SELECT kind, name, file FROM names")) {
        const Kind kind = find_kind(std::get<std::string>(row[0])).value();
        StoredFile named;
        named.kind = kind;
        named.id = std::get<std::string>(row[2]);
        files[index_of.at(place_of(named))].names.insert(std::get<std::string>(row[1]));
    }
    return files;
}

std::string place_of(const StoredFile& file) {
    return str_cat(name_of(file.kind), "/", file.id, extension_of(file.kind));
}

}  // namespace tetralight::server
