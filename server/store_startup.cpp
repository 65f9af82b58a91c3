// SPDX-License-Identifier: Apache-2.0
// How a store starts: its folders, its database, and the files that it finds.
#include <tetralight/server/store.h>

#include <chrono>
#include <filesystem>
#include <new>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/reserve.h>
#include <tetralight/server/store_rows.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

}  // namespace

Store::Store(const Settings& settings, Log& log, Metrics& metrics)
    : settings_(settings), log_(log), metrics_(metrics) {}

Result<std::unique_ptr<Store>> Store::open(const Settings& settings, Log& log, Metrics& metrics) {
    std::unique_ptr<Store> store(new Store(settings, log, metrics));
    if (settings.is_read_only) {
        if (!fs::is_directory(settings.data)) {
            return Error{ErrorCode::NotFound, "data", settings.data,
                         settings.data + ": is not a folder"};
        }
        store->read_index_if_changed();
        if (metrics.damaged_indexes > 0) {
            return Error{ErrorCode::Corrupt, store->index_path() + ": is damaged"};
        }
        store->periodic_.start(std::chrono::milliseconds(500),
                               [s = store.get()] { s->read_index_if_changed(); });
        return store;
    }
    std::vector<std::string> folders{"bakes", "work", "quarantine"};
    for (const Kind kind : kKinds) folders.emplace_back(name_of(kind));
    for (const std::string& folder : folders) {
        auto status = make_folder(settings.data + "/" + folder);
        if (!status) return status.error();
    }
    if (auto status = sync_folder(settings.data); !status) return status.error();
    store->clear_work();
    drop_reserve(store->reserve_path());
    if (auto status = store->open_database(); !status) return status.error();
    try {
        store->match_files();
    } catch (const Problem& problem) {
        return Error{ErrorCode::Unavailable, settings.data + ": " + problem.detail};
    }
    store->write_index();
    return store;
}

void Store::report(const std::string& finding) {
    findings_.push_back(finding);
    log_.write(Log::Level::Error, finding);
}

/// A damaged database goes to the quarantine, and a new one takes its place.
Status Store::open_database() {
    const std::string path = settings_.data + "/tetralight.db";
    const Status first = try_database(path);
    if (first || first.error().code != ErrorCode::Corrupt) return first;
    // SQLite reports a disk that cannot be read as damage, too.
    for (const char* suffix : {"", "-wal"}) {
        const auto ids = read_file_ids(path + suffix);
        if (!ids && can_retry(ids.error().code)) return ids.error();
    }
    const Status second = try_database(path);
    if (second || second.error().code != ErrorCode::Corrupt) return second;
    quarantine_database(path, second.error());
    return try_database(path);
}

/// Opens the database and loads all of it. Returns corrupt if it is damaged.
Status Store::try_database(const std::string& path) {
    auto opened = Database::open(path);
    if (!opened) return opened.error();
    database_.emplace(std::move(*opened));
    Error error;
    try {
        load();
        return Ok{};
    } catch (const DatabaseProblem& problem) {
        error = {problem.reason, path + ": " + problem.detail};
    } catch (const std::bad_alloc&) {
        error = {ErrorCode::OutOfResources, path + ": not enough memory"};
    } catch (const std::exception& exception) {
        error = {ErrorCode::Corrupt, str_cat(path, ": is damaged (", exception.what(), ")")};
    }
    database_.reset();
    return error;
}

void Store::quarantine_database(const std::string& path, const Error& error) {
    const std::string stamp = std::to_string(static_cast<int64_t>(now()));
    for (const char* suffix : {"", "-wal", "-shm"}) {
        put_aside(path + suffix, stamp + "-tetralight.db" + suffix);
    }
    ++metrics_.quarantined;
    report(
        str_cat("the database was damaged and is in quarantine; the files are indexed again, "
                "unfinished bakes are lost (",
                detail_of(error), ")"));
}

void Store::load() {
    for (Files& all : files_) all.clear();
    for (StoredFile& file : read_stored_files(*database_)) {
        files(file.kind)[file.id] = std::move(file);
    }
    index_names_locked();
}

}  // namespace tetralight::server
