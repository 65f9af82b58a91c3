// SPDX-License-Identifier: Apache-2.0
// What a store does at its start with files that have no row, and with rows that have no file.
#include <tetralight/server/store.h>

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

/// When the bytes of a file were written, in seconds since 1970; 0 if it is not there.
double time_of(const std::string& path) {
    struct stat status = {};
    if (::lstat(path.c_str(), &status) != 0) return 0.0;
    return static_cast<double>(status.st_mtim.tv_sec) +
           static_cast<double>(status.st_mtim.tv_nsec) * 1e-9;
}

}  // namespace

/// Deletes the folders of requests. The server names them by numbers.
void Store::clear_work() {
    const std::string folder = settings_.data + "/work/";
    std::error_code ignored;
    for (const std::string& name : names_in(folder, ignored)) {
        if (std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) {
            remove_all(folder + name);
        } else if (put_aside(folder + name, "work-" + name)) {
            report(str_cat("work/", name, " is not of this server and is in quarantine"));
        }
    }
}

void Store::match_files() {
    const auto bytes = read_file(index_path());
    const StoreIndex index = bytes ? parse_store_index(*bytes) : StoreIndex();
    for (const Kind kind : kKinds) match_files_of(kind, index);
}

void Store::match_files_of(Kind kind, const StoreIndex& index) {
    const std::string folder = settings_.data + "/" + name_of(kind);
    std::error_code error;
    std::set<std::string> present = names_in(folder, error);
    if (error) {
        report(str_cat(name_of(kind), " cannot be read (", error.message(),
                       "); its files are served as soon as they can be read"));
        return;
    }
    for (const StoredFile& file : list(kind)) {
        const bool is_present = present.erase(file.id + extension_of(kind)) > 0;
        if (is_present && !file.damage.empty()) heal(file);
        if (is_present || !file.damage.empty()) continue;
        report(str_cat(name_of(kind), "/", file.id,
                       " is missing; it is served as soon as it is there"));
    }
    for (const std::string& name : present) take_in(kind, name, index);
    forget_deleted(kind);
}

/// A damaged file whose bytes are right again is served.
void Store::heal(StoredFile file) {
    const auto ids = read_file_ids(path(file.kind, file.id));
    if (!ids || !ids->contains(file.id)) return;
    file.damage.clear();
    insert(file);
    report(str_cat(name_of(file.kind), "/", file.id, " is whole again"));
}

/// A file without a row is adopted if its bytes have its id, and is put aside otherwise.
void Store::take_in(Kind kind, const std::string& name, const StoreIndex& index) {
    const std::string place = str_cat(name_of(kind), "/", name);
    const std::string from = settings_.data + "/" + place;
    const std::string id = id_in_file_name(kind, name);
    if (!id.empty()) {
        if (is_deleted(kind, id, from)) {
            remove_all(from);
            return;
        }
        const auto ids = read_file_ids(from);
        if (!ids && can_retry(ids.error().code)) {
            report(str_cat(place, " is not in the database and cannot be read (",
                           detail_of(ids.error()), "); the next start tries again"));
            return;
        }
        if (ids && ids->contains(id)) {
            adopt(kind, id, ids->bytes, index);
            report(str_cat(place, " was not in the database and is taken in"));
            return;
        }
    }
    const bool is_aside = put_aside(from, str_cat("unknown-", name_of(kind), "-", name));
    report(str_cat(place, is_aside ? " is not a file of this server and is in quarantine"
                                   : " is not a file of this server"));
}

/// True if the store deleted a file of this id after these bytes were written.
bool Store::is_deleted(Kind kind, const std::string& id, const std::string& path) {
    const auto rows = database_->run("SELECT time FROM deleted WHERE kind = ? AND file = ?",
                                     {std::string(name_of(kind)), id});
    return !rows.empty() && time_of(path) <= std::get<double>(rows[0][0]);
}

/// Once the deleted files of a kind are gone from the disk, nothing about them must be known.
void Store::forget_deleted(Kind kind) {
    const std::string name = name_of(kind);
    const auto rows = database_->run("SELECT file FROM deleted WHERE kind = ?", {name});
    if (rows.empty() || !sync_folder(settings_.data + "/" + name)) return;
    for (const auto& row : rows) {
        const auto& id = std::get<std::string>(row[0]);
        std::error_code error;
        const auto status = fs::symlink_status(path(kind, id), error);
        if (status.type() != fs::file_type::not_found) continue;
        database_->run("DELETE FROM deleted WHERE kind = ? AND file = ?", {name, id});
    }
}

/// With its names and facts if the index has them.
void Store::adopt(Kind kind, const std::string& id, uint64_t bytes, const StoreIndex& index) {
    StoredFile file;
    const auto known = index.files.find(str_cat(name_of(kind), "/", id));
    if (known != index.files.end()) file = known->second;
    file.kind = kind;
    file.id = id;
    file.bytes = bytes;
    file.damage.clear();
    if (file.created == 0.0) file.created = now();
    insert(file);
}

}  // namespace tetralight::server
