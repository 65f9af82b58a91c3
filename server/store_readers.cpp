// SPDX-License-Identifier: Apache-2.0
// index.json: what a store tells servers that only read, and what it learns from it as one of them.
#include <tetralight/server/store.h>

#include <tetralight/base/file.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {

/// A change is stored even if its index cannot be written: the next change brings it up to date.
bool Store::write_index() {
    Json json = Json::array();
    {
        const std::shared_lock lock(mutex_);
        for (const Files& all : files_) {
            for (const auto& [id, file] : all) {
                json.push_back(index_entry(file));
            }
        }
    }
    const std::string bytes = index_text(json);
    const auto write = [&] {
        require_stored(write_file(index_path(), std::as_bytes(std::span(bytes))));
    };
    try {
        with_reserve(write);
        keep_reserve();
        return true;
    } catch (const Problem& problem) {
        log_.write(Log::Level::Error,
                   "index.json could not be written; readers miss the last change",
                   {{"error", problem.detail}});
        return false;
    }
}

/// A damaged index changes nothing.
void Store::read_index_if_changed() {
    const auto stamp = stamp_of(index_path());
    if (!stamp || stamp == index_stamp_) return;
    const auto bytes = read_file(index_path());
    if (!bytes) return;  // perhaps readable later
    index_stamp_ = stamp;
    const StoreIndex index = parse_store_index(*bytes);
    if (!index.is_whole) {
        ++metrics_.damaged_indexes;
        log_.write(Log::Level::Error, "index.json is damaged; the one before it is served");
        return;
    }
    const std::unique_lock lock(mutex_);
    for (Files& all : files_) all.clear();
    for (const auto& [key, file] : index.files) files(file.kind)[file.id] = file;
    index_names_locked();
}

}  // namespace tetralight::server
