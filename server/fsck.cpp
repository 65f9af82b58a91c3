// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/fsck.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <thread>

#include <tetralight/base/file.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/bakes.h>
#include <tetralight/server/database.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/store_index.h>
#include <tetralight/server/store_rows.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

struct Check {
    const std::string& data;
    FolderCheck found;

    void add(const char* kind, const std::string& path, const std::string& detail) {
        found.findings.push_back({kind, path, detail});
    }

    /// `bytes` as the database has it.
    void check_file(const std::string& place, const std::string& id,
                    std::optional<uint64_t> bytes) {
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
            bytes.value_or(ids->bytes) == ids->bytes
                ? "its bytes have changed"
                : str_cat("it has ", ids->bytes, " bytes instead of ", *bytes));
    }

    /// Throws a `DatabaseProblem`.
    void check_by_database(Database& database) {
        std::set<std::string> places;
        for (const StoredFile& file : read_stored_files(database)) {
            places.insert(place_of(file));
            if (!file.damage.empty()) {
                add("damaged", place_of(file), "in quarantine: " + file.damage);
            } else {
                check_file(place_of(file), file.id, file.bytes);
            }
        }
        for (const Kind kind : kKinds) {
            for (const std::string& name : names(name_of(kind))) {
                const std::string place = str_cat(name_of(kind), "/", name);
                if (!places.contains(place)) add("unknown", place, "the database has no row of it");
            }
        }
        check_bakes(database);
        look_again(database);
    }

    /// Folders of bakes that have ended or were not accepted are deleted at the next start.
    void check_bakes(Database& database) {
        std::set<std::string> folders = names("bakes");
        for (const auto& row : database.run("SELECT id, state FROM bakes")) {
            const auto& id = std::get<std::string>(row[0]);
            const bool is_there = folders.erase(id) > 0;
            if (is_there || is_final(std::get<std::string>(row[1]))) continue;
            add("missing", "bakes/" + id, "the bake has not ended and has no folder");
        }
        for (const std::string& name : folders) {
            if (name.starts_with("new-")) continue;
            add("unknown", "bakes/" + name, "the database has no row of it");
        }
    }

    /// A server that runs stores and deletes files between two looks: findings that have become
    /// untrue are dropped.
    void look_again(Database& database) {
        const auto is_of_names = [](const FolderCheck::Finding& finding) {
            return finding.kind == "missing" || finding.kind == "unknown";
        };
        if (std::ranges::none_of(found.findings, is_of_names)) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        std::erase_if(found.findings, [&](const FolderCheck::Finding& finding) {
            std::error_code error;
            const auto status = fs::symlink_status(data + "/" + finding.path, error);
            const bool is_there = status.type() != fs::file_type::not_found;
            return is_of_names(finding) && is_there == is_expected(database, finding.path);
        });
    }

    /// True if the database has a row for a file or folder: of a bake, one that has not ended.
    static bool is_expected(Database& database, const std::string& place) {
        const size_t slash = place.find('/');
        const std::string folder = place.substr(0, slash), name = place.substr(slash + 1);
        if (const auto kind = find_kind(folder)) {
            const std::string id = id_in_file_name(*kind, name);
            return !database.run("SELECT 1 FROM files WHERE kind = ? AND id = ?", {folder, id})
                        .empty();
        }
        return !database
                    .run("SELECT 1 FROM bakes WHERE id = ? AND state IN ('queued', 'running')",
                         {name})
                    .empty();
    }

    /// Without a database.
    void check_by_names() {
        for (const Kind kind : kKinds) {
            for (const std::string& name : names(name_of(kind))) {
                const std::string place = str_cat(name_of(kind), "/", name);
                const std::string id = id_in_file_name(kind, name);
                if (id.empty()) {
                    add("unknown", place, "its name has no id");
                } else {
                    check_file(place, id, {});
                }
            }
        }
    }

    /// The names in a folder; none without it, as every file in it is missing then.
    std::set<std::string> names(const std::string& folder) {
        std::error_code error;
        std::set<std::string> all = names_in(data + "/" + folder, error);
        if (error && error != std::errc::no_such_file_or_directory) {
            add("unreadable", folder, error.message());
        }
        return all;
    }

    /// What servers read that share the folder.
    void check_index() {
        const auto bytes = read_file(data + "/index.json");
        if (bytes && parse_store_index(*bytes).is_whole) return;
        if (bytes) {
            add("damaged", "index.json", "it is no index; the next change or start writes it");
        } else if (bytes.error().code == ErrorCode::NotFound) {
            add("missing", "index.json", "the next change or start writes it");
        } else {
            add("unreadable", "index.json", detail_of(bytes.error()));
        }
    }

    void count_quarantine() {
        std::error_code ignored;
        found.quarantined += names_in(data + "/quarantine", ignored).size();
    }
};

/// True if there is a file or folder that only a server makes.
bool is_of_server(const std::string& data) {
    const auto is_there = [&](const std::string& name) {
        std::error_code error;
        return fs::exists(data + "/" + name, error);
    };
    return is_there("tetralight.db") || is_there("index.json") ||
           std::ranges::all_of(kKinds, [&](Kind kind) {
               // Early servers had neither.
               const bool is_later = kind == Kind::Lightmaps || kind == Kind::Reflections;
               return is_later || is_there(name_of(kind));
           });
}

/// Returns an error only if the database is out of reach.
Status check_all(Check& check, const std::string& path) {
    auto database = Database::open_to_read(path);
    std::string damage;
    if (!database && database.error().code != ErrorCode::Corrupt) return database.error();
    if (!database) damage = detail_of(database.error());
    try {
        if (database) check.check_by_database(*database);
    } catch (const DatabaseProblem& problem) {
        damage = problem.detail;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        damage = exception.what();  // rows that do not fit each other
    }
    if (damage.empty()) return Ok{};
    check.found = {};
    check.add("database", "tetralight.db", damage);
    check.check_by_names();
    return Ok{};
}

}  // namespace

Result<FolderCheck> check_folder(const std::string& data) {
    if (!is_of_server(data)) {
        return Error{ErrorCode::NotFound, "data", data,
                     shown_path(data) + ": is not the data folder of a server"};
    }
    const std::string path = data + "/tetralight.db";
    Check check{data, {}};
    std::error_code error;
    if (fs::exists(path, error)) {
        if (auto status = check_all(check, path); !status) return status.error();
    } else {
        check.add("missing", "tetralight.db",
                  "the next start makes a new one from the files and index.json, without bakes");
        check.check_by_names();
    }
    check.check_index();
    check.count_quarantine();
    return std::move(check.found);
}

}  // namespace tetralight::server
