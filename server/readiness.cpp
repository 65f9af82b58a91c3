// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/readiness.h>

#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tetralight::server {
namespace {

/// Between looks, and until a look that has not ended counts as a fault.
constexpr std::chrono::milliseconds kPause(250);
constexpr std::chrono::seconds kLongest(3);

bool is_same_file(const std::optional<FileStamp>& a, const std::optional<FileStamp>& b) {
    return a && b && a->device == b->device && a->number == b->number;
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
      index_(settings.data + "/index.json"),
      folder_stamp_(stamp_of(folder_)),
      database_stamp_(stamp_of(database_)),
      state_(look()) {
    periodic_.start(kPause, [this] {
        State state = look();
        const std::lock_guard lock(mutex_);
        state_ = std::move(state);
    });
}

Readiness::State Readiness::look() const {
    const auto begin = Clock::now();
    return {fault_of_folder(), disk_of(folder_), begin};
}

std::optional<std::string> Readiness::fault_of_writer() const {
    const auto database = stamp_of(database_);
    if (!database) return "the database is gone";
    if (!is_same_file(database, database_stamp_)) {
        return "the database is not the one that was opened";
    }
    for (const std::string& path : {folder_, database_}) {
        if (::access(path.c_str(), W_OK) == 0) continue;
        return std::string("the data folder cannot be written: ") + std::strerror(errno);
    }
    return std::nullopt;
}

std::optional<std::string> Readiness::fault_of_folder() const {
    const auto folder = stamp_of(folder_);
    if (!folder) return "the data folder is gone";
    // Readers open files by their paths, so they go on when their folder is mounted again.
    if (is_read_only_) {
        if (stamp_of(index_)) return std::nullopt;
        return "the data folder has no index.json";
    }
    if (!is_same_file(folder, folder_stamp_)) {
        return "the data folder is not the one that was opened";
    }
    return fault_of_writer();
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
