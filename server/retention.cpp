// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/retention.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include <tetralight/server/problem.h>

namespace tetralight::server {

Retention::Retention(Store& store, Bakes& bakes, OpenVolumes& volumes, Log& log)
    : store_(store), bakes_(bakes), volumes_(volumes), log_(log) {
    if (store.is_read_only() || !store.settings().keep.is_limited()) return;
    thread_ = std::thread([this] { run(); });
}

Retention::~Retention() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Retention::run() {
    constexpr std::chrono::seconds kPause(2);
    std::unique_lock lock(mutex_);
    do {
        lock.unlock();
        try {
            delete_volumes();
            delete_bakes();
        } catch (const Problem& problem) {
            log_.write(Log::Level::Error, "what is too old could not be deleted",
                       {{"error", problem.detail}});
        } catch (const std::exception& exception) {
            log_.write(Log::Level::Error, "what is too old could not be deleted",
                       {{"error", exception.what()}});
        }
        lock.lock();
    } while (!wake_.wait_for(lock, kPause, [&] { return is_ending_; }));
}

void Retention::delete_volumes() {
    auto unnamed = store_.list(Kind::Volumes);
    std::erase_if(unnamed, [](const StoredFile& file) {
        return !file.names.empty() || !file.damage.empty();
    });
    std::ranges::sort(unnamed, std::greater(), &StoredFile::created);
    for (size_t i = 0; i < unnamed.size(); ++i) {
        const StoredFile& file = unnamed[i];
        if (!store_.settings().keep.is_over(file.created, i, now())) continue;
        if (!store_.remove_unnamed(Kind::Volumes, file.id)) continue;
        volumes_.forget(file.id);
        log_.write(Log::Level::Info, "a volume without a name was deleted", {{"id", file.id}});
    }
}

void Retention::delete_bakes() {
    const Json all = bakes_.list();
    size_t newer = 0;
    for (const Json& bake : all) {
        if (!bake.contains("ended")) continue;
        if (!store_.settings().keep.is_over(bake["ended"], newer++, now())) continue;
        const std::string id = bake["id"];
        bakes_.remove(id);
        log_.write(Log::Level::Info, "a bake that ended was deleted", {{"bake", id}});
    }
}

}  // namespace tetralight::server
