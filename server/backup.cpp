// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/backup.h>

#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <new>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/archive_list.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/store_index.h>
#include <tetralight/server/store_rows.h>
#include <tetralight/server/tar.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

constexpr size_t kPiece = size_t{1} << 20;

class Backup {
  public:
    Backup(const std::string& data, TarWriter& tar, const IsCancelled& is_cancelled)
        : data_(data), tar_(tar), is_cancelled_(is_cancelled) {}

    /// Throws a `DatabaseProblem`.
    Status add_all(Database& live) {
        // Before the copy: of a bake that ends in the meantime the copy has its volume.
        if (auto status = add_folder("bakes"); !status) return status;
        Database copy = live.copy_to_memory();
        if (auto status = add_new_bakes(live, copy); !status) return status;
        for (const StoredFile& file : read_stored_files(copy)) {
            if (auto status = add_stored(file, live, copy); !status) return status;
        }
        if (auto status = add_folder("quarantine"); !status) return status;
        Json entries = Json::array();
        for (const StoredFile& file : read_stored_files(copy)) entries.push_back(index_entry(file));
        if (auto status = add_text(kIndexName, index_text(entries)); !status) return status;
        if (auto status = add_bytes(kDatabaseName, copy.bytes()); !status) return status;
        return add_text(kListName, text_of(list_));
    }

    BackupReport report;

  private:
    /// Bakes that were ordered before the copy was made, but after their folders were stored.
    Status add_new_bakes(Database& live, Database& copy) {
        constexpr const char* kUnfinished =
            "SELECT id FROM bakes WHERE state IN ('queued', 'running') AND id LIKE ?";
        for (const auto& row : copy.run(kUnfinished, {"%"})) {
            const auto& id = std::get<std::string>(row[0]);
            const std::string folder = "bakes/" + id;
            if (holds_any_below(folder)) continue;
            if (auto status = add_folder(folder); !status) return status;
            if (holds_any_below(folder)) continue;
            if (live.run(kUnfinished, {id}).empty()) continue;  // it has ended since
            report.missing.push_back(shown_path(data_ + "/" + folder) + ": is not there");
        }
        return Ok{};
    }

    [[nodiscard]] bool holds_any_below(const std::string& folder) const {
        const auto next = list_.lower_bound(folder + "/");
        return next != list_.end() && next->first.starts_with(folder + "/");
    }

    /// A file that was deleted since the copy was made is no longer part of it.
    Status add_stored(const StoredFile& file, Database& live, Database& copy) {
        if (!file.damage.empty()) return Ok{};  // in quarantine
        const std::string place = place_of(file);
        const auto source = open_regular(data_ + "/" + place);
        if (source) return add_file(place, *source, file.id);
        const Database::Row key{std::string(name_of(file.kind)), file.id};
        if (live.run("SELECT 1 FROM files WHERE kind = ? AND id = ?", key).empty()) {
            copy.run("DELETE FROM files WHERE kind = ? AND id = ?", key);
        } else {
            report.missing.push_back(detail_of(source.error()));
        }
        return Ok{};
    }

    /// Files that go away in the meantime belong to bakes that ended or were taken back.
    Status add_folder(const std::string& folder) {
        std::error_code error;
        for (const std::string& name : files_below(folder, error)) {
            const auto source = open_regular(data_ + "/" + name);
            if (!source && source.error().code == ErrorCode::NotFound) continue;
            if (!source) {
                report.missing.push_back(detail_of(source.error()));
            } else if (auto status = add_file(name, *source, ""); !status) {
                return status;
            }
        }
        if (error && error != std::errc::no_such_file_or_directory) {
            report.missing.push_back(
                str_cat(shown_path(data_ + "/" + folder), ": cannot read (", error.message(), ")"));
        }
        return Ok{};
    }

    /// By their names relative to the data folder.
    std::vector<std::string> files_below(const std::string& folder, std::error_code& error) const {
        std::vector<std::string> names;
        fs::recursive_directory_iterator entry(data_ + "/" + folder, error);
        for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
            std::error_code ignored;
            if (entry->symlink_status(ignored).type() != fs::file_type::regular) continue;
            names.push_back(entry->path().lexically_relative(data_).string());
        }
        std::ranges::sort(names);
        return names;
    }

    /// Stores the bytes that the file has now, although it may grow. Zeros take the place of what
    /// cannot be read. Its bytes must have the id, unless that is empty.
    Status add_file(const std::string& name, const Descriptor& source, const std::string& id) {
        struct stat status = {};
        if (!TarWriter::can_hold(name) || ::fstat(source.value(), &status) != 0) {
            report.missing.push_back(shown_path(name) + ": an archive cannot hold this name");
            return Ok{};
        }
        auto left = static_cast<uint64_t>(status.st_size);
        if (auto done = tar_.begin({name, left, status.st_mtim.tv_sec}); !done) return done;
        std::string fault;
        FileIdsHash hash;
        std::vector<std::byte> memory(std::min<uint64_t>(left, kPiece));
        while (left > 0) {
            const auto piece = std::span(memory).first(std::min<uint64_t>(memory.size(), left));
            if (fault.empty()) fault = read_or_clear(source, piece);
            if (auto done = add_piece(piece, hash); !done) return done;
            left -= piece.size();
        }
        const FileIds ids = note(name, hash);
        if (fault.empty() && !id.empty() && !ids.contains(id)) {
            fault = "its bytes do not have its id";
        }
        if (!fault.empty()) report.damaged.push_back(shown_path(data_ + "/" + name) + ": " + fault);
        return Ok{};
    }

    /// Zeros from where the file cannot be read on. Returns the reason.
    static std::string read_or_clear(const Descriptor& source, std::span<std::byte> piece) {
        const auto count = read_up_to(source, piece);
        if (count && *count == piece.size()) return "";
        const std::string fault =
            count ? "became shorter" : detail_of(system_error("read all of it"));
        std::ranges::fill(piece.subspan(count.value_or(0)), std::byte{0});
        return fault;
    }

    Status add_text(const char* name, const std::string& text) {
        return add_bytes(name, std::as_bytes(std::span(text)));
    }

    Status add_bytes(const char* name, std::span<const std::byte> bytes) {
        const TarEntry entry{name, bytes.size(), static_cast<int64_t>(std::time(nullptr))};
        if (auto status = tar_.begin(entry); !status) return status;
        FileIdsHash hash;
        if (auto status = add_piece(bytes, hash); !status) return status;
        (void)note(name, hash);
        return Ok{};
    }

    Status add_piece(std::span<const std::byte> piece, FileIdsHash& hash) {
        if (is_cancelled_()) return Error{ErrorCode::Cancelled, "backup: interrupted"};
        hash.add(piece);
        return tar_.write(piece);
    }

    FileIds note(const std::string& name, const FileIdsHash& hash) {
        const FileIds ids = hash.ids();
        list_[name] = ids;
        ++report.files;
        report.bytes += ids.bytes;
        return ids;
    }

    const std::string& data_;
    TarWriter& tar_;
    const IsCancelled& is_cancelled_;
    ArchiveList list_;
};

/// True if a file would be written into the folder.
bool lies_in(const std::string& path, const std::string& folder) {
    const auto target = follow_links(path);
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(target ? *target : path, error);
    const fs::path outer = fs::weakly_canonical(folder, error);
    return std::ranges::mismatch(outer, inner).in1 == outer.end();
}

Status check_places(const std::string& data, const std::string& archive) {
    std::error_code error;
    if (!fs::exists(data + "/" + kDatabaseName, error)) {
        return Error{ErrorCode::NotFound, "data", data,
                     shown_path(data) + ": holds no tetralight.db, the database of a server"};
    }
    if (archive == "-" || !lies_in(archive, data)) return Ok{};
    return Error{ErrorCode::InvalidArgument, "output", archive,
                 shown_path(archive) + ": lies in the data folder"};
}

}  // namespace

Result<BackupReport> back_up(const std::string& data, const std::string& archive,
                             const IsCancelled& is_cancelled) {
    if (auto status = check_places(data, archive); !status) return status.error();
    auto database = Database::open_to_read(data + "/" + kDatabaseName);
    if (!database) return database.error();
    auto tar = TarWriter::open(archive);
    if (!tar) return tar.error();
    Backup backup(data, *tar, is_cancelled);
    try {
        if (auto status = backup.add_all(*database); !status) return status.error();
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, shown_path(data) + ": " + problem.detail};
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt, str_cat(shown_path(data), ": the database is damaged (",
                                                 exception.what(), ")")};
    }
    if (auto status = tar->commit(); !status) return status.error();
    return backup.report;
}

}  // namespace tetralight::server
