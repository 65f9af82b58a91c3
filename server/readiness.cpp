// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/readiness.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstring>

namespace tetralight::server {

Readiness::Readiness(const Settings& settings)
    : is_read_only_(settings.is_read_only),
      folder_(settings.data),
      database_(settings.data + "/tetralight.db"),
      index_(settings.data + "/index.json"),
      folder_identity_(identify(folder_)),
      database_identity_(identify(database_)) {}

std::optional<Readiness::Identity> Readiness::identify(const std::string& path) {
    struct stat facts = {};
    if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
    return Identity{facts.st_dev, facts.st_ino};
}

std::optional<std::string> Readiness::fault_of_writer() const {
    const auto database = identify(database_);
    if (!database) return "the database is gone";
    if (database != database_identity_) return "the database is not the one that was opened";
    for (const std::string& path : {folder_, database_}) {
        if (::access(path.c_str(), W_OK) == 0) continue;
        return std::string("the data folder cannot be written: ") + std::strerror(errno);
    }
    return std::nullopt;
}

std::optional<std::string> Readiness::fault() const {
    const auto folder = identify(folder_);
    if (!folder) return "the data folder is gone";
    // Readers open files by their paths, so they go on when their folder is mounted again.
    if (is_read_only_) {
        if (identify(index_)) return std::nullopt;
        return "the data folder has no index.json";
    }
    if (folder != folder_identity_) return "the data folder is not the one that was opened";
    return fault_of_writer();
}

}  // namespace tetralight::server
