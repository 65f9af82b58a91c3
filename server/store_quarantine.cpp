// SPDX-License-Identifier: Apache-2.0
// What a store does with files whose bytes are wrong.
#include <tetralight/server/store.h>

#include <unistd.h>

#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

}  // namespace

void Store::quarantine(Kind kind, const std::string& id, const std::string& damage) {
    ++metrics_.quarantined;
    log_.write(Log::Level::Error, "a file is damaged",
               {{"kind", name_of(kind)}, {"id", id}, {"damage", damage}});
    {
        const std::unique_lock lock(mutex_);
        const auto found = files(kind).find(id);
        if (found == files(kind).end()) return;
        found->second.damage = damage;
    }
    if (is_read_only()) return;
    try {
        with_reserve([&] {
            database_->run("UPDATE files SET damage = ? WHERE kind = ? AND id = ?",
                           {damage, std::string(name_of(kind)), id});
        });
    } catch (const Problem& problem) {
        log_.write(Log::Level::Error, "damage could not be stored", {{"error", problem.detail}});
    }
    put_aside(path(kind, id), str_cat(name_of(kind), "-", id, extension_of(kind)));
}

bool Store::put_aside(const std::string& from, const std::string& name) const {
    const std::string folder = quarantine_folder();
    std::error_code error;
    std::string to = folder + name;
    // Nothing in the quarantine is replaced.
    for (int i = 1; fs::exists(fs::symlink_status(to, error)); ++i) {
        to = str_cat(folder, i, "-", name);
    }
    fs::rename(from, to, error);
    return !error;
}

StoredFile Store::take_back(Kind kind, const std::string& id, const std::string& from) {
    const std::lock_guard change(change_mutex_);
    const FileIds ids = require_file_ids(from);
    if (!ids.contains(id)) {
        throw Problem{422, "bad_data", "its bytes do not have its id: they are damaged", "name",
                      fs::path(from).filename().string()};
    }
    StoredFile file;
    if (const auto known = find(kind, id)) file = *known;
    file.kind = kind;
    file.id = id;
    file.bytes = ids.bytes;
    file.damage.clear();
    if (file.created == 0.0) file.created = now();
    require_stored(move_synced(from, path(kind, id)));
    insert(file);
    write_index();
    return file;
}

void Store::remove_quarantined(const std::string& name) {
    const std::lock_guard change(change_mutex_);
    std::error_code error;
    fs::remove_all(quarantine_folder() + name, error);
    if (error) {
        throw storage_problem({error_code_of_errno(error.value()),
                               "quarantine: cannot be deleted (" + error.message() + ")"});
    }
    log_.write(Log::Level::Info, "an entry of the quarantine was deleted", {{"name", name}});
    keep_reserve();
}

void Store::link(const StoredFile& file, const std::string& to) {
    const std::string from = path(file.kind, file.id);
    if (!require_file_ids(from).contains(file.id)) {
        quarantine(file.kind, file.id, "its bytes have changed");
        (void)get(file.kind, file.id);  // throws
    }
    if (::link(from.c_str(), to.c_str()) != 0) require_stored(system_error(to, "link"));
}

}  // namespace tetralight::server
