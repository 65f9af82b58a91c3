// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/folders.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include <tetralight/base/system_error.h>

namespace tetralight::server {
namespace {

Status sync(const std::string& path, int flags) {
    const Descriptor file(::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC));
    if (!file || ::fsync(file.value()) != 0) return system_error(path, "sync");
    return Ok{};
}

Status made(const std::string& path, const std::error_code& error) {
    if (!error) return Ok{};
    return Error{error_code_of_errno(error.value()),
                 path + ": cannot create the folder (" + error.message() + ")"};
}

}  // namespace

Status make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    return made(path, error);
}

Status make_subfolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directory(path, error);
    return made(path, error);
}

Status sync_folder(const std::string& path) {
    return sync(path, O_DIRECTORY);
}

Status sync_file(const std::string& path) {
    return sync(path, 0);
}

Status move_synced(const std::string& from, const std::string& to) {
    if (auto status = sync_file(from); !status) return status;
    if (std::rename(from.c_str(), to.c_str()) != 0) return system_error(to, "write");
    return sync_folder(std::filesystem::path(to).parent_path().string());
}

Status move_folder_synced(const std::string& from, const std::string& to) {
    if (std::rename(from.c_str(), to.c_str()) != 0) return system_error(to, "write");
    return sync_folder(std::filesystem::path(to).parent_path().string());
}

std::set<std::string> names_in(const std::string& folder, std::error_code& error) {
    std::set<std::string> names;
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        names.insert(entry->path().filename().string());
        entry.increment(error);
    }
    return names;
}

void remove_all(const std::string& path) {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

}  // namespace tetralight::server
