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
    periodic_.start(std::chrono::seconds(2), [this] { delete_old(); });
    periodic_.wake();
}

void Retention::delete_old() {
    const auto report = [&](const std::string& error) {
        log_.write(Log::Level::Error, "what is too old could not be deleted", {{"error", error}});
    };
    try {
        for (const Kind kind : {Kind::Volumes, Kind::Lightmaps, Kind::Reflections})
            delete_unnamed(kind);
        delete_bakes();
    } catch (const Problem& problem) {
        report(problem.detail);
    } catch (const std::exception& exception) {
        report(exception.what());
    }
}

void Retention::delete_unnamed(Kind kind) {
    auto unnamed = store_.list(kind);
    std::erase_if(unnamed, [](const StoredFile& file) {
        return !file.names.empty() || !file.damage.empty();
    });
    std::ranges::sort(unnamed, std::greater(), &StoredFile::created);
    for (size_t i = 0; i < unnamed.size(); ++i) {
        const StoredFile& file = unnamed[i];
        if (!store_.settings().keep.is_over(file.created, i, now())) continue;
        if (!store_.remove_unnamed(kind, file.id)) continue;
        if (kind == Kind::Volumes) volumes_.forget(file.id);
        log_.write(Log::Level::Info, "a file without a name was deleted",
                   {{"kind", name_of(kind)}, {"id", file.id}});
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
