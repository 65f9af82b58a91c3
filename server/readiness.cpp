// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/readiness.h>

#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/stored_file.h>

namespace tetralight::server {
namespace {

/// Between looks, and until a look that has not ended counts as a fault.
constexpr std::chrono::milliseconds kPause(250);
constexpr std::chrono::seconds kLongest(3);

bool is_same_file(const std::optional<FileStamp>& a, const std::optional<FileStamp>& b) {
    return a && b && a->device == b->device && a->number == b->number;
}

/// Why a path, of which clients see only `name`, does not allow this use; nothing if it does.
std::optional<std::string> refusal(const std::string& path, const std::string& name, int use) {
    if (::access(path.c_str(), use) == 0) return std::nullopt;
    const std::string reason = std::strerror(errno);
    return str_cat(name, " cannot be ", use & W_OK ? "written" : "read", ": ", reason);
}

std::optional<Readiness::Disk> disk_of(const std::string& folder) {
    struct statvfs disk = {};
    if (::statvfs(folder.c_str(), &disk) != 0) return std::nullopt;
    return Readiness::Disk{disk.f_bavail * disk.f_frsize, disk.f_blocks * disk.f_frsize};
}

}  // namespace

Readiness::Readiness(const Settings& settings)
    : is_read_only_(settings.is_read_only),
      folder_(settings.data),
      database_(settings.data + "/tetralight.db"),
      log_(database_ + "-wal"),
      index_(settings.data + "/index.json"),
      folder_stamp_(stamp_of(folder_)),
      database_stamp_(stamp_of(database_)),
      log_stamp_(stamp_of(log_)),
      state_(look()) {
    periodic_.start(kPause, [this] {
        State state = look();
        const std::lock_guard lock(mutex_);
        state_ = std::move(state);
    });
}

Readiness::State Readiness::look() const {
    const auto begin = Clock::now();
    return {find_fault(), disk_of(folder_), begin};
}

/// Why what is written now is not found again.
std::optional<std::string> Readiness::fault_of_database() const {
    const auto folder = stamp_of(folder_);
    if (!folder) return "the data folder is gone";
    if (!is_same_file(folder, folder_stamp_)) {
        return "the data folder is not the one that was opened";
    }
    const auto database = stamp_of(database_);
    if (!database) return "the database is gone";
    if (!is_same_file(database, database_stamp_)) {
        return "the database is not the one that was opened";
    }
    // SQLite keeps it for as long as the database is open.
    if (log_stamp_ && !is_same_file(stamp_of(log_), log_stamp_)) {
        return "the log of the database is not the one that was opened";
    }
    for (const std::string& path : {folder_, database_}) {
        if (auto fault = refusal(path, "the data folder", W_OK)) return fault;
    }
    return std::nullopt;
}

/// Why files cannot be stored or read.
std::optional<std::string> Readiness::fault_of_folders() const {
    for (const Kind kind : kKinds) {
        if (is_read_only_ && kind != Kind::Volumes) continue;
        const std::string name = name_of(kind);
        const int right = is_read_only_ ? R_OK | X_OK : R_OK | W_OK | X_OK;
        if (auto fault = refusal(str_cat(folder_, "/", name, "/"), name, right)) return fault;
    }
    for (const char* name : {"bakes", "work", "quarantine"}) {
        if (is_read_only_) break;
        if (auto fault = refusal(str_cat(folder_, "/", name, "/"), name, R_OK | W_OK | X_OK)) {
            return fault;
        }
    }
    return std::nullopt;
}

std::optional<std::string> Readiness::find_fault() const {
    if (!is_read_only_) {
        const auto fault = fault_of_database();
        return fault ? fault : fault_of_folders();
    }
    // Readers open files by their paths, so they go on when their folder is mounted again.
    if (!stamp_of(folder_)) return "the data folder is gone";
    if (!stamp_of(index_)) return "the data folder has no index.json";
    return fault_of_folders();
}

void Readiness::require_database() const {
    if (const auto fault = fault_of_database()) throw Problem{503, "unavailable", *fault};
}

std::optional<std::string> Readiness::fault() const {
    const std::lock_guard lock(mutex_);
    if (Clock::now() - state_.time > kPause + kLongest) return "the data folder does not answer";
    return state_.fault;
}

std::optional<Readiness::Disk> Readiness::disk() const {
    const std::lock_guard lock(mutex_);
    return state_.disk;
}

}  // namespace tetralight::server
