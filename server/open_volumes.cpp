// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/open_volumes.h>

#include <tetralight/server/problem.h>

namespace tetralight::server {

std::shared_ptr<const ProbeFile> OpenVolumes::open(const std::string& reference) {
    const StoredFile stored = store_.get(Kind::Volumes, reference);
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = by_id_.find(stored.id); found != by_id_.end()) {
            entries_.splice(entries_.begin(), entries_, found->second);
            return found->second->file;
        }
    }
    // Without the lock, because this reads the whole file. Two threads may do it at once.
    const std::string path = store_.path(Kind::Volumes, stored.id);
    auto opened = open_probe_file(path);
    if (!opened) {
        // It may have been deleted since.
        if (!store_.find(Kind::Volumes, stored.id)) (void)store_.get(Kind::Volumes, reference);
        if (opened.error().code != ErrorCode::Corrupt) throw storage_problem(opened.error());
        store_.quarantine(Kind::Volumes, stored.id, reason_without_path(opened.error(), path));
        (void)store_.get(Kind::Volumes, stored.id);
    }
    auto file = std::make_shared<const ProbeFile>(std::move(*opened));
    const std::lock_guard lock(mutex_);
    if (by_id_.contains(stored.id)) return by_id_[stored.id]->file;
    entries_.push_front({stored.id, file});
    by_id_[stored.id] = entries_.begin();
    if (entries_.size() > kMostOpen) {
        by_id_.erase(entries_.back().id);
        entries_.pop_back();
    }
    return file;
}

void OpenVolumes::forget(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return;
    entries_.erase(found->second);
    by_id_.erase(found);
}

size_t OpenVolumes::count() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
}

}  // namespace tetralight::server
