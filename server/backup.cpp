// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/backup.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/database.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/stored_file.h>
#include <tetralight/server/tar.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatabase = "tetralight.db";
/// What an archive may hold.
constexpr std::array kTops{kDatabase, "index.json", "scenes",     "skies",
                           "groups",  "volumes",    "quarantine", "bakes"};

/// All files below a folder, by their names relative to `data`.
std::vector<std::string> files_below(const std::string& data, const char* folder) {
    std::vector<std::string> names;
    std::error_code error;
    fs::recursive_directory_iterator entry(data + "/" + folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        std::error_code ignored;
        if (entry->symlink_status(ignored).type() != fs::file_type::regular) continue;
        names.push_back(entry->path().lexically_relative(data).string());
    }
    std::ranges::sort(names);
    return names;
}

/// Adds files to an archive and counts them.
class Backup {
  public:
    Backup(const std::string& data, TarWriter& tar) : data_(data), tar_(tar) {}

    /// The service runs on during a backup: bakes may progress, and files may be deleted.
    Status add_if_there(const std::string& name) {
        auto status = add(name, data_ + "/" + name);
        return status || status.error().code != ErrorCode::NotFound ? status : Ok{};
    }

    Status add(const std::string& name, const std::string& path) {
        if (auto status = tar_.add(name, path); !status) return status;
        std::error_code ignored;
        ++report.files;
        report.bytes += fs::file_size(path, ignored);
        return Ok{};
    }

    Status add_stored(const Database::Row& row) {
        const auto kind = find_kind(std::get<std::string>(row[0]));
        if (!kind || !std::get<std::string>(row[2]).empty()) return Ok{};
        const std::string name =
            str_cat(name_of(*kind), "/", std::get<std::string>(row[1]), extension_of(*kind));
        auto status = add(name, data_ + "/" + name);
        if (status || status.error().code != ErrorCode::NotFound) return status;
        report.missing.push_back(detail_of(status.error()));
        return Ok{};
    }

    BackupReport report;

  private:
    const std::string& data_;
    TarWriter& tar_;
};

Status add_all(const std::string& data, const std::string& copy, Backup& backup) {
    if (auto status = backup.add(kDatabase, copy); !status) return status;
    if (auto status = backup.add_if_there("index.json"); !status) return status;
    auto database = Database::open_to_read(copy);
    if (!database) return database.error();
    for (const auto& row : database->run("SELECT kind, id, damage FROM files ORDER BY kind, id")) {
        if (auto status = backup.add_stored(row); !status) return status;
    }
    for (const char* folder : {"bakes", "quarantine"}) {
        for (const std::string& name : files_below(data, folder)) {
            if (auto status = backup.add_if_there(name); !status) return status;
        }
    }
    return Ok{};
}

/// Throws a `DatabaseProblem`.
Result<BackupReport> back_up_through(const std::string& data, const std::string& archive,
                                     const std::string& copy) {
    auto database = Database::open_to_read(data + "/" + kDatabase);
    if (!database) return database.error();
    database->run("VACUUM INTO ?", {copy});
    auto tar = TarWriter::open(archive);
    if (!tar) return tar.error();
    Backup backup(data, *tar);
    if (auto status = add_all(data, copy, backup); !status) return status.error();
    if (auto status = tar->commit(); !status) return status.error();
    return backup.report;
}

/// True if the bytes of a stored file must have the id in its name.
bool has_wrong_bytes(const std::string& name, const std::string& path) {
    const fs::path place(name);
    if (!find_kind(place.parent_path().string())) return false;
    const auto ids = read_file_ids(path);
    return !ids || !ids->contains(place.stem().string());
}

Status restore_entry(TarReader& tar, const TarEntry& entry, const std::string& folder) {
    const std::string path = folder + "/" + entry.name;
    const std::string top = entry.name.substr(0, entry.name.find('/'));
    const bool is_known = std::ranges::find(kTops, top) != kTops.end();
    if (!is_known) {
        return Error{ErrorCode::Corrupt,
                     shown_path(entry.name) + " does not belong to a data folder"};
    }
    if (auto status = make_folder(fs::path(path).parent_path().string()); !status) return status;
    auto writer = FileWriter::open(path);
    if (!writer) return writer.error();
    std::vector<std::byte> memory(size_t{1} << 20);
    while (true) {
        const auto piece = tar.read(memory);
        if (!piece) return piece.error();
        if (piece->empty()) break;
        if (auto status = writer->write(*piece); !status) return status;
    }
    if (auto status = writer->commit(); !status) return status;
    if (!has_wrong_bytes(entry.name, path)) return Ok{};
    return Error{ErrorCode::Corrupt, shown_path(entry.name) + ": its bytes do not have its id"};
}

Result<BackupReport> restore_into(TarReader& tar, const std::string& archive,
                                  const std::string& folder) {
    BackupReport report;
    std::set<std::string> names;
    while (true) {
        const auto entry = tar.next();
        if (!entry) return entry.error();
        if (!*entry) break;
        const bool is_new = names.insert((*entry)->name).second;
        const Status status = is_new ? restore_entry(tar, **entry, folder)
                                     : Error{ErrorCode::Corrupt, shown_path((*entry)->name) +
                                                                     " is in the archive twice"};
        if (!status) return status.error().in(shown_path(archive));
        ++report.files;
        report.bytes += (*entry)->size;
    }
    if (names.contains(kDatabase)) return report;
    return Error{ErrorCode::Corrupt, shown_path(archive) + ": holds no database"};
}

/// Syncs the names in a folder and in all below it.
Status sync_folders(const std::string& folder) {
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        if (!entry->is_directory()) continue;
        if (auto status = sync_folder(entry->path().string()); !status) return status;
    }
    return sync_folder(folder);
}

}  // namespace

Result<BackupReport> back_up(const std::string& data, const std::string& archive) {
    const std::string copy = str_cat(archive, ".", ::getpid(), ".db");
    remove_all(copy);
    try {
        auto report = back_up_through(data, archive, copy);
        remove_all(copy);
        return report;
    } catch (const DatabaseProblem& problem) {
        remove_all(copy);
        return Error{problem.reason, shown_path(data) + ": " + problem.detail};
    }
}

Result<BackupReport> restore(const std::string& archive, const std::string& data) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(data, error)) && !fs::is_empty(data, error)) {
        return Error{ErrorCode::InvalidArgument, "output", data,
                     shown_path(data) + ": is not an empty folder"};
    }
    auto tar = TarReader::open(archive);
    if (!tar) return tar.error();
    const std::string folder = str_cat(data, ".", ::getpid(), ".restore");
    if (auto status = make_folder(folder); !status) return status.error();
    auto report = restore_into(*tar, archive, folder);
    if (report) {
        auto status = sync_folders(folder);
        if (status) status = move_folder_synced(folder, data);
        if (!status) report = status.error();
    }
    if (!report) remove_all(folder);
    return report;
}

}  // namespace tetralight::server
