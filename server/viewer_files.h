// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <tetralight/server/file_stamp.h>
#include <tetralight/server/http.h>

namespace tetralight::server {

/// The static files of the web page. Keeps the files that were asked for in memory and reads one
/// again when it changes. Thread-safe.
///
/// `NAME.gz` beside a file is sent instead of it to clients that accept gzip, unless it is older.
class ViewerFiles {
  public:
    /// Empty: there is no page, and `/` says how to get one.
    explicit ViewerFiles(std::string folder) : folder_(std::move(folder)) {}

    /// Answers GET and HEAD of a path that no route has. Throws a `Problem`: 404 if there is no
    /// such file in the folder.
    [[nodiscard]] Response respond(const Request& request) const;

  private:
    struct File {
        FileStamp stamp;
        std::string tag;  ///< the entity tag without its quotes
        Body body;
    };

    [[nodiscard]] std::shared_ptr<const File> find(const std::string& path) const;
    [[nodiscard]] std::shared_ptr<const File> find_in_folder(const std::string& name) const;

    const std::string folder_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const File>> files_;  ///< by path
};

}  // namespace tetralight::server
