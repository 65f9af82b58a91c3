// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/backup.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <set>

#include <tetralight/base/file.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/archive_list.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/store_index.h>
#include <tetralight/server/store_rows.h>
#include <tetralight/server/tar.h>
#include <tetralight/server/unfinished_folder.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

/// Fills a folder from an archive.
class Restore {
  public:
    Restore(TarReader& tar, const std::string& archive, const std::string& folder)
        : tar_(tar), archive_(archive), folder_(folder) {}

    /// Throws a `DatabaseProblem`.
    Status run() {
        if (auto status = read_entries(); !status) return status;
        if (!present_.contains(kDatabaseName)) return corrupt("holds no database");
        if (auto status = check_list(); !status) return status;
        auto database = Database::open_copy(path_of(kDatabaseName));
        if (!database && database.error().code != ErrorCode::Corrupt) return database.error();
        if (!database) return corrupt("its tetralight.db is damaged or not of a server");
        return check_files(*database);
    }

    [[nodiscard]] BackupReport report() const {
        return {present_.size(), bytes_, lines_of(missing_), lines_of(damaged_)};
    }

  private:
    using Faults = std::map<std::string, std::string>;  ///< by the name of the file

    [[nodiscard]] static std::vector<std::string> lines_of(const Faults& faults) {
        std::vector<std::string> lines;
        for (const auto& [name, fault] : faults) lines.push_back(shown_path(name) + ": " + fault);
        return lines;
    }

    [[nodiscard]] std::string path_of(const std::string& name) const {
        return folder_ + "/" + name;
    }

    [[nodiscard]] Error corrupt(const std::string& reason) const {
        return {ErrorCode::Corrupt, "archive", archive_, shown_path(archive_) + ": " + reason};
    }

    Status read_entries() {
        while (true) {
            const auto entry = tar_.next();
            if (!entry) return entry.error();
            if (!*entry) return Ok{};
            const std::string& name = (*entry)->name;
            if (!belongs_to_archive(name)) {
                return corrupt(shown_path(name) + " does not belong to a data folder");
            }
            if (present_.contains(name)) return corrupt(shown_path(name) + " is in it twice");
            const auto ids = read_entry(name);
            if (!ids) return ids.error();
            present_[name] = *ids;
            bytes_ += ids->bytes;
        }
    }

    Result<FileIds> read_entry(const std::string& name) {
        const std::string path = path_of(name);
        if (auto status = make_folder(fs::path(path).parent_path().string()); !status) {
            return status.error();
        }
        auto writer = FileWriter::open(path);
        if (!writer) return writer.error();
        FileIdsHash hash;
        std::vector<std::byte> memory(size_t{1} << 20);
        while (true) {
            const auto piece = tar_.read(memory);
            if (!piece) return piece.error();
            if (piece->empty()) break;
            hash.add(*piece);
            if (auto status = writer->write(*piece); !status) return status.error();
        }
        if (auto status = writer->commit(); !status) return status.error();
        return hash.ids();
    }

    /// Compares the files with the list. Archives of early builds have none; ids and the database
    /// tell most of it.
    Status check_list() {
        const auto bytes = read_file(path_of(kListName));
        remove_all(path_of(kListName));
        if (!bytes) {
            missing_[kListName] = "is not in the archive, so that not every file could be checked";
            return Ok{};
        }
        const auto list = parse_archive_list(*bytes);
        if (!list) return corrupt("its backup.json is damaged");
        for (const auto& [name, ids] : *list) {
            const auto found = present_.find(name);
            if (found == present_.end()) {
                missing_[name] = "is not in the archive";
            } else if (found->second.id != ids.id) {
                damaged_[name] = "its bytes have changed";
            }
        }
        if (damaged_.contains(kDatabaseName)) return corrupt("its tetralight.db is damaged");
        for (const auto& [name, ids] : present_) {
            if (name == kListName || list->contains(name)) continue;
            return corrupt(shown_path(name) + " is not in its backup.json");
        }
        return Ok{};
    }

    /// Compares the stored files with the database, and writes the index anew from it.
    Status check_files(Database& database) {
        std::set<std::string> places;
        Json entries = Json::array();
        for (StoredFile& file : read_stored_files(database)) {
            places.insert(place_of(file));
            if (auto status = check_file(file, database); !status) return status;
            entries.push_back(index_entry(file));
        }
        for (const auto& [name, ids] : present_) {
            const bool is_stored = find_kind(name.substr(0, name.find('/'))).has_value();
            if (is_stored && !places.contains(name)) {
                return corrupt(shown_path(name) + " is not in its database");
            }
        }
        const std::string text = index_text(entries);
        return write_file(path_of(kIndexName), std::as_bytes(std::span(text)));
    }

    /// A file with wrong bytes goes to the quarantine, as the server would do.
    Status check_file(StoredFile& file, Database& database) {
        if (!file.damage.empty()) return Ok{};
        const std::string place = place_of(file);
        const auto found = present_.find(place);
        if (found == present_.end()) missing_[place] = "is not in the archive";
        if (found == present_.end() || found->second.contains(file.id)) return Ok{};
        file.damage = "its bytes do not have its id";
        damaged_[place] = file.damage + "; it is in the quarantine";
        database.run("UPDATE files SET damage = ? WHERE kind = ? AND id = ?",
                     {file.damage, std::string(name_of(file.kind)), file.id});
        return put_aside(file);
    }

    /// Nothing in the quarantine is replaced.
    Status put_aside(const StoredFile& file) {
        if (auto status = make_folder(path_of("quarantine")); !status) return status;
        const std::string name = str_cat(name_of(file.kind), "-", file.id, extension_of(file.kind));
        std::string to = path_of("quarantine/" + name);
        std::error_code error;
        for (int i = 1; fs::exists(fs::symlink_status(to, error)); ++i) {
            to = path_of(str_cat("quarantine/", i, "-", name));
        }
        if (std::rename(path_of(place_of(file)).c_str(), to.c_str()) == 0) return Ok{};
        return system_error(to, "write");
    }

    TarReader& tar_;
    const std::string& archive_;
    const std::string& folder_;
    ArchiveList present_;
    uint64_t bytes_ = 0;
    Faults missing_, damaged_;
};

/// The place to write to: behind links, without slashes at its end.
Result<std::string> place_for(const std::string& data) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(data, error)) && !fs::is_empty(data, error)) {
        return Error{ErrorCode::InvalidArgument, "output", data,
                     shown_path(data) + ": is not an empty folder"};
    }
    std::string place = data;
    while (place.size() > 1 && place.ends_with('/')) place.pop_back();
    return follow_links(place);
}

Status fill(const std::string& archive, Restore& work) {
    try {
        return work.run();
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, "archive", archive,
                     shown_path(archive) + ": " + problem.detail};
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt, "archive", archive,
                     str_cat(shown_path(archive), ": its tetralight.db is damaged (",
                             exception.what(), ")")};
    }
}

}  // namespace

Result<BackupReport> restore(const std::string& archive, const std::string& data,
                             const IsCancelled& is_cancelled) {
    const auto place = place_for(data);
    if (!place) return place.error();
    auto tar = TarReader::open(archive);
    if (!tar) return tar.error();
    tar->set_stop(is_cancelled);
    auto folder = UnfinishedFolder::make(*place);
    if (!folder) return folder.error();
    Restore work(*tar, archive, folder->path());
    if (auto status = fill(archive, work); !status) return status.error();
    if (auto status = folder->move_into_place(); !status) return status.error();
    return work.report();
}

}  // namespace tetralight::server
