// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <system_error>

#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight::server {

/// Creates a folder and its parents. An existing folder is no error.
[[nodiscard]] Status make_folder(const std::string& path);

/// Creates a folder in one that exists: nothing is made below a mount point whose disk is away.
[[nodiscard]] Status make_subfolder(const std::string& path);

/// Syncs the names in a folder, so that files created or renamed in it survive a power cut.
[[nodiscard]] Status sync_folder(const std::string& path);

/// Syncs the bytes of a file.
[[nodiscard]] Status sync_file(const std::string& path);

/// Moves a file and syncs the file and its new name.
[[nodiscard]] Status move_synced(const std::string& from, const std::string& to);

/// Moves a folder and syncs its old and its new name. Its contents must be synced before.
[[nodiscard]] Status move_folder_synced(const std::string& from, const std::string& to);

/// The names in a folder; with `error`, those that could be read.
[[nodiscard]] std::set<std::string> names_in(const std::string& folder, std::error_code& error);

/// Deletes a file, or a folder with its contents. A missing one is no error.
void remove_all(const std::string& path);

/// A temporary folder that is deleted with this object.
class WorkFolder {
  public:
    explicit WorkFolder(std::string path) : path_(std::move(path)) {}

    WorkFolder(WorkFolder&& other) noexcept : path_(std::exchange(other.path_, "")) {}

    WorkFolder& operator=(WorkFolder&&) = delete;

    ~WorkFolder() {
        if (!path_.empty()) remove_all(path_);
    }

    [[nodiscard]] const std::string& path() const { return path_; }

    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

}  // namespace tetralight::server
