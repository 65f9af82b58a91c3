// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/store.h>

#include <sys/stat.h>

#include <chrono>
#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/reserve.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

/// True if the disk has the file, in the size that the store knows.
bool has_file(const std::string& path, uint64_t bytes) {
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
           static_cast<uint64_t>(status.st_size) == bytes;
}

}  // namespace

double now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

const StoredFile* Store::find_locked(Kind kind, const std::string& reference) {
    const Files& all = files(kind);
    if (const auto found = all.find(reference); found != all.end()) return &found->second;
    const auto& names = id_of_name_[static_cast<size_t>(kind)];
    const auto named = names.find(reference);
    return named == names.end() ? nullptr : &all.at(named->second);
}

void Store::index_names_locked() {
    for (const Kind kind : kKinds) {
        auto& names = id_of_name_[static_cast<size_t>(kind)];
        names.clear();
        for (const auto& [id, file] : files(kind)) {
            for (const std::string& name : file.names) names[name] = id;
        }
    }
}

std::optional<StoredFile> Store::find(Kind kind, const std::string& reference) {
    const std::shared_lock lock(mutex_);
    const StoredFile* file = find_locked(kind, reference);
    return file == nullptr ? std::nullopt : std::optional(*file);
}

StoredFile Store::get(Kind kind, const std::string& reference) {
    auto file = find(kind, reference);
    const bool is_plural =
        kind == Kind::Groups || kind == Kind::Lightmaps || kind == Kind::Reflections;
    if (!file) {
        throw Problem{
            404, "not_found",
            str_cat(is_plural ? "there are no such " : "there is no such ", noun_of(kind)),
            noun_of(kind), reference.substr(0, 200)};
    }
    if (!file->damage.empty()) {
        throw Problem{
            410, "quarantined",
            str_cat("the ", noun_of(kind), is_plural ? " are" : " is", " damaged: ", file->damage),
            noun_of(kind), file->id};
    }
    return std::move(*file);
}

std::vector<StoredFile> Store::list(Kind kind) {
    const std::shared_lock lock(mutex_);
    std::vector<StoredFile> all;
    for (const auto& [id, file] : files(kind)) all.push_back(file);
    return all;
}

/// In the database and in memory. Names move from the files that had them.
void Store::insert(const StoredFile& file) {
    const std::string kind = name_of(file.kind);
    database_->transaction([&] {
        database_->run(
            "INSERT OR REPLACE INTO files (id, kind, bytes, created, facts, damage) "
            "VALUES (?, ?, ?, ?, ?, ?)",
            {file.id, kind, static_cast<int64_t>(file.bytes), file.created, file.facts,
             file.damage});
        database_->run("DELETE FROM deleted WHERE kind = ? AND file = ?", {kind, file.id});
        database_->run("DELETE FROM names WHERE kind = ? AND file = ?", {kind, file.id});
        for (const std::string& name : file.names) {
            database_->run("INSERT OR REPLACE INTO names (kind, name, file) VALUES (?, ?, ?)",
                           {kind, name, file.id});
        }
    });
    const std::unique_lock lock(mutex_);
    for (auto& [id, other] : files(file.kind)) {
        for (const std::string& name : file.names) other.names.erase(name);
    }
    files(file.kind)[file.id] = file;
    index_names_locked();
}

/// The file that holds these bytes. An old id does not prove that they are the same.
std::optional<StoredFile> Store::find_bytes(Kind kind, const std::string& from,
                                            const FileIds& ids) {
    if (auto file = find(kind, ids.id)) return file;
    auto file = find(kind, ids.old_id);
    if (!file || !file->damage.empty()) return std::nullopt;
    const auto are_same = have_same_bytes(path(kind, file->id), from);
    if (!are_same && can_retry(are_same.error().code)) throw storage_problem(are_same.error());
    return are_same && *are_same ? file : std::nullopt;
}

Store::Added Store::add(Kind kind, const std::string& from, const std::string& name,
                        const Json& facts) {
    check_name(name);
    const std::lock_guard change(change_mutex_);
    const FileIds ids = require_file_ids(from);
    const std::optional<StoredFile> known = find_bytes(kind, from, ids);
    StoredFile file;
    file.id = known ? known->id : ids.id;
    file.bytes = ids.bytes;
    const bool is_new = !known || !known->damage.empty();
    if (is_new) {
        check_quota(file.bytes);
        file.kind = kind;
        file.created = now();
        file.facts = dump(facts);
        if (known) file.names = known->names;
    } else {
        file = *known;
    }
    // A file that is out of reach or cut short comes back with the same bytes.
    const bool is_moved = is_new || !has_file(path(kind, file.id), file.bytes);
    if (is_moved) require_stored(move_synced(from, path(kind, file.id)));
    const bool has_new_name = !name.empty() && file.names.insert(name).second;
    if (is_new || has_new_name) {
        try {
            insert(file);
        } catch (const Problem&) {
            std::error_code ignored;
            if (is_new) fs::rename(path(kind, file.id), from, ignored);
            throw;
        }
        write_index();
    }
    return {file, is_new};
}

/// Removes the row of a file. If the file outlives it, because the disk fails or the server is
/// killed, the next start deletes the file instead of adopting it.
void Store::drop_row(const StoredFile& file) {
    const std::string kind = name_of(file.kind);
    database_->transaction([&] {
        database_->run("DELETE FROM files WHERE kind = ? AND id = ?", {kind, file.id});
        database_->run("INSERT OR REPLACE INTO deleted (kind, file, time) VALUES (?, ?, ?)",
                       {kind, file.id, now()});
    });
}

StoredFile Store::rename(Kind kind, const std::string& reference, const std::string& name,
                         const Condition& condition) {
    check_name(name);
    const std::lock_guard change(change_mutex_);
    StoredFile file = get(kind, reference);
    if (condition) condition(file);
    if (!is_id(reference)) file.names.erase(reference);
    if (is_id(reference) && name.empty()) file.names.clear();
    if (!name.empty()) file.names.insert(name);
    insert(file);
    write_index();
    return file;
}

void Store::remove(Kind kind, const std::string& reference, const Condition& condition) {
    const std::lock_guard change(change_mutex_);
    auto file = find(kind, reference);
    if (!file) (void)get(kind, reference);  // throws
    if (condition) condition(*file);
    if (!is_id(reference) && file->names.size() > 1) {
        file->names.erase(reference);
        with_reserve([&] { insert(*file); });
        write_index();
        return;
    }
    remove_locked(*file);
}

bool Store::remove_unnamed(Kind kind, const std::string& id) {
    const std::lock_guard change(change_mutex_);
    const auto file = find(kind, id);
    if (!file || !file->names.empty()) return false;
    remove_locked(*file);
    return true;
}

/// The row, the index and the file. Precondition: no other change runs.
void Store::remove_locked(const StoredFile& file) {
    with_reserve([&] { drop_row(file); });
    {
        const std::unique_lock lock(mutex_);
        files(file.kind).erase(file.id);
        index_names_locked();
    }
    const bool is_index_written = write_index();
    remove_all(path(file.kind, file.id));
    if (!is_index_written) write_index();
    keep_reserve();
}

std::string Store::path(Kind kind, const std::string& id) const {
    return settings_.data + "/" + name_of(kind) + "/" + id + extension_of(kind);
}

std::string Store::bake_folder(const std::string& id) const {
    return settings_.data + "/bakes/" + id;
}

WorkFolder Store::make_work_folder() {
    const std::string folder = str_cat(settings_.data, "/work/", ++work_count_);
    require_stored(make_subfolder(folder));
    return WorkFolder(folder);
}

uint64_t Store::total_bytes() const {
    const std::shared_lock lock(mutex_);
    uint64_t sum = 0;
    for (const Files& all : files_) {
        for (const auto& [id, file] : all) sum += file.damage.empty() ? file.bytes : 0;
    }
    return sum;
}

void Store::check_quota(uint64_t more) const {
    if (settings_.quota_bytes == 0 || total_bytes() + more <= settings_.quota_bytes) return;
    throw Problem{507, "quota", str_cat("the store may hold ", settings_.quota_bytes, " bytes"),
                  "quota", std::to_string(more)};
}

void Store::with_reserve(const std::function<void()>& work) {
    try {
        work();
    } catch (const Problem& problem) {
        if (problem.code != "disk_full") throw;
        drop_reserve(reserve_path());
        work();
        keep_reserve();
    }
}

void Store::keep_reserve() const {
    server::keep_reserve(reserve_path());
}

}  // namespace tetralight::server
