// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight::server {

/// Makes a folder and those above it; fine when it is there.
[[nodiscard]] Status make_folder(const std::string& path);

/// Puts the names in a folder on the disk: what was renamed or made in it stays after a power cut.
[[nodiscard]] Status sync_folder(const std::string& path);

/// Puts a file's bytes on the disk.
[[nodiscard]] Status sync_file(const std::string& path);

/// Moves a file, and puts both the file and its new name on the disk.
[[nodiscard]] Status move_synced(const std::string& from, const std::string& to);

/// Deletes a folder with all that is in it, or a file; fine when it is not there.
void remove_all(const std::string& path);

/// A folder for one piece of work; gone with this object.
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
