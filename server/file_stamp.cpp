// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/file_stamp.h>

#include <sys/stat.h>

namespace tetralight::server {
namespace {

int64_t nanoseconds(const timespec& time) {
    return int64_t{time.tv_sec} * 1'000'000'000 + int64_t{time.tv_nsec};
}

FileStamp stamp_from(const struct stat& facts) {
    return {facts.st_dev, facts.st_ino, static_cast<uint64_t>(facts.st_size),
            nanoseconds(facts.st_mtim), nanoseconds(facts.st_ctim)};
}

}  // namespace

bool FileStamp::has_same_bytes(const FileStamp& other) const {
    FileStamp same = other;
    same.changed = changed;
    return *this == same;
}

std::optional<FileStamp> stamp_of(const std::string& path) {
    struct stat facts = {};
    if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
    return stamp_from(facts);
}

std::optional<FileStamp> stamp_of(const Descriptor& file) {
    struct stat facts = {};
    if (::fstat(file.value(), &facts) != 0) return std::nullopt;
    return stamp_from(facts);
}

}  // namespace tetralight::server
