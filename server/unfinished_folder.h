// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/result.h>

namespace tetralight::server {

/// A folder that is filled beside its place and moved there when it is complete. It is deleted with
/// this object, or, if the process was killed, by the next one that fills the same place.
class UnfinishedFolder {
  public:
    /// Makes `PLACE.PROCESS.restore`. Precondition: `place` does not end with a slash.
    [[nodiscard]] static Result<UnfinishedFolder> make(const std::string& place);

    UnfinishedFolder(UnfinishedFolder&& other) noexcept = default;
    UnfinishedFolder& operator=(UnfinishedFolder&&) = delete;
    ~UnfinishedFolder();

    [[nodiscard]] const std::string& path() const { return path_; }

    /// Syncs the names in it and moves it to its place, where nothing or an empty folder may be.
    [[nodiscard]] Status move_into_place();

  private:
    UnfinishedFolder(std::string place, std::string path)
        : place_(std::move(place)), path_(std::move(path)) {}

    std::string place_;
    std::string path_;
    Descriptor lock_;  ///< tells others that this process lives
};

}  // namespace tetralight::server
