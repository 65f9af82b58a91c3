// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/unfinished_folder.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/folders.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnd = ".restore";

/// Holds a folder as long as it is open, for a process that lives. Nothing if another one holds it,
/// or if it is not there.
Descriptor lock(const std::string& folder) {
    Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (lock && ::flock(lock.value(), LOCK_EX | LOCK_NB) == 0) return lock;
    return Descriptor();
}

/// True for "PLACE.123.restore".
bool is_unfinished(const std::string& name, const std::string& place) {
    const std::string end = kEnd;
    if (!name.starts_with(place + ".") || !name.ends_with(end)) return false;
    if (name.size() <= place.size() + 1 + end.size()) return false;
    const std::string process =
        name.substr(place.size() + 1, name.size() - place.size() - 1 - end.size());
    return std::ranges::all_of(process, [](char c) { return c >= '0' && c <= '9'; });
}

void remove_those_of_dead_processes(const fs::path& place) {
    const fs::path parent = place.has_parent_path() ? place.parent_path() : ".";
    std::error_code ignored;
    for (const std::string& name : names_in(parent.string(), ignored)) {
        if (!is_unfinished(name, place.filename().string())) continue;
        const std::string path = (parent / name).string();
        if (lock(path)) remove_all(path);
    }
}

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

Result<UnfinishedFolder> UnfinishedFolder::make(const std::string& place) {
    remove_those_of_dead_processes(place);
    UnfinishedFolder folder(place, str_cat(place, ".", ::getpid(), kEnd));
    if (auto status = make_folder(folder.path_); !status) return status.error();
    folder.lock_ = lock(folder.path_);
    return folder;
}

UnfinishedFolder::~UnfinishedFolder() {
    if (!path_.empty()) remove_all(path_);
}

Status UnfinishedFolder::move_into_place() {
    if (auto status = sync_folders(path_); !status) return status;
    if (std::rename(path_.c_str(), place_.c_str()) != 0) return system_error(place_, "write");
    path_.clear();
    const fs::path parent = fs::path(place_).parent_path();
    return sync_folder(parent.empty() ? "." : parent.string());
}

}  // namespace tetralight::server
