// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/verified_files.h>

#include <fcntl.h>

#include <algorithm>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

/// True if a file changed so recently that a later change may have the same time: the clock of file
/// systems stands still for milliseconds, on some for a second or two.
bool may_hide_changes(const FileStamp& stamp) {
    constexpr int64_t kSafe = 2'500'000'000;
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    const int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
    return now - std::max(stamp.written, stamp.changed) < kSafe;
}

}  // namespace

bool VerifiedFile::is_intact() const {
    const auto now = stamp_of(file);
    return now && now->has_same_bytes(stamp);
}

std::shared_ptr<const VerifiedFile> VerifiedFiles::open(Kind kind, const std::string& id) {
    const std::string path = store_.path(kind, id);
    const auto refuse = [&](const Error& error) {
        (void)store_.get(kind, id);  // throws if it was deleted since
        throw storage_problem(noun_of(kind), error, path);
    };
    auto opened = std::make_shared<VerifiedFile>();
    opened->file = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!opened->file) refuse(system_error(path, "open"));
    // Taken before the bytes are read: what changes meanwhile makes it differ.
    const auto stamp = stamp_of(opened->file);
    if (!stamp) refuse(system_error(path, "read"));
    opened->stamp = *stamp;
    if (!is_known(path, *stamp)) verify(kind, id, *opened);
    auto mapping = MappedFile::open(path_of_descriptor(opened->file));
    if (!mapping) refuse(mapping.error());
    opened->mapping = std::move(*mapping);
    return opened;
}

bool VerifiedFiles::is_known(const std::string& path, const FileStamp& stamp) {
    const std::chrono::duration<double> longest(store_.settings().recheck_seconds);
    const std::lock_guard lock(mutex_);
    const auto found = checks_.find(path);
    return found != checks_.end() && found->second.stamp == stamp &&
           Clock::now() - found->second.time < longest;
}

void VerifiedFiles::verify(Kind kind, const std::string& id, const VerifiedFile& opened) {
    const std::string path = path_of_descriptor(opened.file);
    const auto ids = read_file_ids(path);
    if (!ids) throw storage_problem(noun_of(kind), ids.error(), path);
    if (ids->contains(id)) return remember(store_.path(kind, id), opened.stamp);
    if (!opened.is_intact()) {
        throw Problem{503, "unavailable", "the file changed while it was read"};
    }
    (void)store_.get(kind, id);  // throws if it was deleted since
    store_.quarantine(kind, id, "its bytes have changed");
    (void)store_.get(kind, id);  // throws
}

void VerifiedFiles::remember(const std::string& path, const FileStamp& stamp) {
    constexpr size_t kMost = size_t{1} << 16;
    if (may_hide_changes(stamp)) return;
    const std::lock_guard lock(mutex_);
    if (checks_.size() >= kMost) checks_.clear();
    checks_[path] = {stamp, Clock::now()};
}

}  // namespace tetralight::server
