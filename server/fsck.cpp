// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/fsck.h>

#include <filesystem>
#include <set>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/database.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/stored_file.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

struct Check {
    const std::string& data;
    FolderCheck found;

    void add(const char* kind, const std::string& path, const std::string& detail) {
        found.findings.push_back({kind, path, detail});
    }

    void check_file(const std::string& place, const std::string& id, uint64_t bytes) {
        ++found.files;
        const auto ids = read_file_ids(data + "/" + place);
        if (!ids) {
            const bool is_missing = ids.error().code == ErrorCode::NotFound;
            add(is_missing ? "missing" : "unreadable", place, detail_of(ids.error()));
            return;
        }
        found.bytes += ids->bytes;
        if (ids->contains(id)) return;
        add("damaged", place,
            ids->bytes == bytes ? "its bytes have changed"
                                : str_cat("it has ", ids->bytes, " bytes instead of ", bytes));
    }

    /// Checks the files that the database names; gives their places.
    std::set<std::string> check_rows(Database& database) {
        std::set<std::string> places;
        for (const auto& row : database.run("SELECT kind, id, bytes, damage FROM files")) {
            const auto kind = find_kind(std::get<std::string>(row[0]));
            if (!kind) continue;
            const auto& id = std::get<std::string>(row[1]);
            const std::string place = str_cat(name_of(*kind), "/", id, extension_of(*kind));
            places.insert(place);
            const auto& damage = std::get<std::string>(row[3]);
            if (!damage.empty()) {
                add("damaged", place, "in quarantine: " + damage);
            } else {
                check_file(place, id, static_cast<uint64_t>(std::get<int64_t>(row[2])));
            }
        }
        return places;
    }

    void check_names(const std::set<std::string>& places) {
        for (const Kind kind : kKinds) {
            std::error_code error;
            for (const std::string& name : names_in(data + "/" + name_of(kind), error)) {
                const std::string place = str_cat(name_of(kind), "/", name);
                if (!places.contains(place)) add("unknown", place, "the database has no row of it");
            }
            // Without the folder, every file in it is missing.
            const bool is_there = error != std::errc::no_such_file_or_directory;
            if (error && is_there) add("unreadable", name_of(kind), error.message());
        }
    }

    void count_quarantine() {
        std::error_code ignored;
        found.quarantined += names_in(data + "/quarantine", ignored).size();
    }
};

}  // namespace

Result<FolderCheck> check_folder(const std::string& data) {
    const std::string path = data + "/tetralight.db";
    std::error_code error;
    if (!fs::exists(path, error)) {
        return Error{ErrorCode::NotFound, "data", data,
                     shown_path(data) + ": is not the data folder of a server"};
    }
    Check check{data, {}};
    std::set<std::string> places;
    auto database = Database::open_to_read(path);
    if (database) {
        try {
            places = check.check_rows(*database);
            check.check_names(places);
        } catch (const DatabaseProblem& problem) {
            check.add("database", "tetralight.db", problem.detail);
        }
    } else if (database.error().code == ErrorCode::Corrupt) {
        check.add("database", "tetralight.db", detail_of(database.error()));
    } else {
        return database.error();
    }
    check.count_quarantine();
    return std::move(check.found);
}

}  // namespace tetralight::server
