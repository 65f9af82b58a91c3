// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <tetralight/base/file.h>
#include <tetralight/base/process/descriptor.h>
#include <tetralight/server/file_stamp.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// An open file whose bytes had its id when it was opened.
struct VerifiedFile {
    Descriptor file;
    MappedFile mapping;
    FileStamp stamp;

    /// False if it was written to since. Deleting and linking it changes nothing.
    [[nodiscard]] bool is_intact() const;
};

/// Stored files for downloads. A file is hashed when it is opened for the first time, when anything
/// about it has changed since, and after `recheck_seconds`. Thread-safe.
class VerifiedFiles {
  public:
    /// Keeps a reference.
    explicit VerifiedFiles(Store& store) : store_(store) {}

    /// By id. Reads the whole file if it must be hashed. Throws a `Problem`: 404 if there is none;
    /// 410 if it is damaged, and moves it to the quarantine; 503 if it cannot be read for now.
    [[nodiscard]] std::shared_ptr<const VerifiedFile> open(Kind kind, const std::string& id);

  private:
    using Clock = std::chrono::steady_clock;

    struct Check {
        FileStamp stamp;
        Clock::time_point time;
    };

    [[nodiscard]] bool is_known(const std::string& path, const FileStamp& stamp);
    void verify(Kind kind, const std::string& id, const VerifiedFile& opened);
    void remember(const std::string& path, const FileStamp& stamp);

    Store& store_;
    std::mutex mutex_;
    std::map<std::string, Check> checks_;  ///< by path
};

}  // namespace tetralight::server
