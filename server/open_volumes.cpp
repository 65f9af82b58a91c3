// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/open_volumes.h>

#include <algorithm>

#include <tetralight/server/file_ids.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {

OpenVolumes::OpenVolumes(Store& store) : store_(store) {
    const std::chrono::duration<double> pause(
        std::min(1.0, store_.settings().recheck_seconds / 2.0));
    periodic_.start(pause, [this] { check_oldest(); });
}

std::shared_ptr<const LoadedVolume> OpenVolumes::open(const std::string& reference) {
    const StoredFile stored = store_.get(Kind::Volumes, reference);
    if (auto known = find(stored.id)) return known;
    // Without the lock, because this reads the whole file. Two threads may do it at once.
    const std::string path = store_.path(Kind::Volumes, stored.id);
    auto loaded = load_volume(path, stored.id, store_.settings().copy_limit_bytes);
    if (!loaded) {
        // It may have been deleted since.
        if (!store_.find(Kind::Volumes, stored.id)) (void)store_.get(Kind::Volumes, reference);
        if (loaded.error().code != ErrorCode::Corrupt) {
            throw storage_problem("volume", loaded.error(), path);
        }
        store_.quarantine(Kind::Volumes, stored.id, reason_without_path(loaded.error(), path));
        (void)store_.get(Kind::Volumes, stored.id);  // throws
    }
    return keep(stored.id, std::move(*loaded));
}

std::shared_ptr<const LoadedVolume> OpenVolumes::find_known(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->volume;
}

/// The volume if it is open. One whose bytes may have changed since it was verified is opened anew,
/// and so verified again. If only something else about its file has changed, such as a link of a
/// job to it, it is verified in the background.
std::shared_ptr<const LoadedVolume> OpenVolumes::find(const std::string& id) {
    auto volume = find_known(id);
    if (!volume || volume->is_copy()) return volume;
    // Without the lock, because the disk may not answer.
    const auto now = stamp_of(volume->path);
    const bool has_changed = volume->is_damaged() || volume->has_changed(now);
    const std::lock_guard lock(mutex_);
    const auto found = by_id_.find(id);
    if (found == by_id_.end() || found->second->volume != volume) return nullptr;
    if (has_changed) {
        erase_locked(found->second);
        return nullptr;
    }
    if (now && now != found->second->stamp) {
        found->second->stamp = now;
        found->second->is_due = true;
        periodic_.wake();
    }
    return volume;
}

std::shared_ptr<const LoadedVolume> OpenVolumes::keep(const std::string& id, LoadedVolume volume) {
    auto kept = std::make_shared<const LoadedVolume>(std::move(volume));
    const std::lock_guard lock(mutex_);
    if (by_id_.contains(id)) return by_id_[id]->volume;
    if (kept->is_copy()) copied_bytes_ += kept->bytes;
    entries_.push_front({id, kept, Clock::now(), kept->stamp});
    by_id_[id] = entries_.begin();
    const uint64_t most_bytes = kMostCopies * store_.settings().copy_limit_bytes;
    while (entries_.size() > kMostOpen) erase_locked(std::prev(entries_.end()));
    for (auto entry = std::prev(entries_.end());
         copied_bytes_ > most_bytes && entry != entries_.begin();) {
        const auto oldest = entry--;
        if (oldest->volume->is_copy()) erase_locked(oldest);
    }
    return kept;
}

void OpenVolumes::erase_locked(std::list<Entry>::iterator entry) {
    if (entry->volume->is_copy()) copied_bytes_ -= entry->volume->bytes;
    by_id_.erase(entry->id);
    entries_.erase(entry);
}

void OpenVolumes::forget(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = by_id_.find(id);
    if (found != by_id_.end()) erase_locked(found->second);
}

size_t OpenVolumes::count() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
}

/// Reads the file of one mapped volume again.
void OpenVolumes::check_oldest() {
    if (const std::string id = next_to_check(); !id.empty()) check(id);
}

/// A mapped volume that is due, else that whose check is the oldest if it is old enough.
std::string OpenVolumes::next_to_check() {
    const std::lock_guard lock(mutex_);
    const Entry* oldest = nullptr;
    for (const Entry& entry : entries_) {
        if (entry.volume->is_copy()) continue;
        if (entry.is_due) return entry.id;
        if (oldest == nullptr || entry.checked < oldest->checked) oldest = &entry;
    }
    const std::chrono::duration<double> interval(store_.settings().recheck_seconds);
    return oldest != nullptr && Clock::now() - oldest->checked >= interval ? oldest->id : "";
}

void OpenVolumes::check(const std::string& id) {
    set_checked(id);
    const auto ids = read_file_ids(store_.path(Kind::Volumes, id));
    if (ids && !ids->contains(id) && store_.find(Kind::Volumes, id)) {
        forget(id);
        store_.quarantine(Kind::Volumes, id, "its bytes have changed");
    }
}

/// Before its file is read: what changes meanwhile makes it due again.
void OpenVolumes::set_checked(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return;
    found->second->checked = Clock::now();
    found->second->is_due = false;
}

}  // namespace tetralight::server
