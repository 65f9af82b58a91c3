// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/store.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/base/utf8.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/reserve.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKindNames[] = {"scenes", "skies", "groups", "volumes"};
constexpr const char* kKindNouns[] = {"scene", "sky", "groups", "volume"};
constexpr const char* kExtensions[] = {".glb", ".hdr", ".json", ".probes"};
constexpr size_t kIdLength = 32;

std::string id_of(std::span<const std::byte> bytes) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
    std::string id;
    for (const unsigned char byte : canonical.digest) {
        std::array<char, 3> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x", byte);
        id += digits.data();
    }
    return id;
}

/// Bytes of a file of the store. Throws.
MappedFile map(const std::string& path) {
    auto file = MappedFile::open(path);
    if (!file) throw Problem{500, "storage", error_text(file.error())};
    return std::move(*file);
}

std::optional<Kind> kind_of(const std::string& name) {
    const auto found = std::ranges::find(kKindNames, name);
    if (found == std::end(kKindNames)) return std::nullopt;
    return static_cast<Kind>(found - std::begin(kKindNames));
}

/// Of an entry of the index. Before files had several names, there was "name" alone.
std::set<std::string> names_of(const Json& entry) {
    if (entry.contains("names")) return entry["names"];
    const std::string name = entry.at("name");
    return name.empty() ? std::set<std::string>() : std::set{name};
}

/// Files by "kind/id".
struct Index {
    std::map<std::string, StoredFile> files;
    bool is_whole = false;
};

StoredFile read_entry(Kind kind, const Json& entry) {
    return {.kind = kind,
            .id = entry.at("id"),
            .names = names_of(entry),
            .bytes = entry.at("bytes"),
            .created = entry.at("created"),
            .facts = dump(entry.at("facts")),
            .damage = entry.value("damage", "")};
}

/// What is whole of an index.
Index parse_index(std::span<const std::byte> bytes) {
    const Json json = object_in(bytes);
    Index index;
    if (!json.contains("files")) return index;
    index.is_whole = true;
    for (const Json& entry : json["files"]) {
        try {
            const auto kind = kind_of(entry.at("kind"));
            if (!kind) continue;  // of a later version
            StoredFile file = read_entry(*kind, entry);
            index.is_whole &= is_id(file.id);
            if (is_id(file.id))
                index.files[str_cat(name_of(*kind), "/", file.id)] = std::move(file);
        } catch (const Json::exception&) {
            index.is_whole = false;
        }
    }
    return index;
}

}  // namespace

const char* name_of(Kind kind) {
    return kKindNames[static_cast<size_t>(kind)];
}

const char* noun_of(Kind kind) {
    return kKindNouns[static_cast<size_t>(kind)];
}

const char* extension_of(Kind kind) {
    return kExtensions[static_cast<size_t>(kind)];
}

bool is_id(const std::string& text) {
    return text.size() == kIdLength && std::ranges::all_of(text, [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

void require_stored(const Status& status) {
    if (status) return;
    const bool is_full = error_text(status.error()).find("No space left") != std::string::npos;
    throw Problem{is_full ? 507u : 500u, is_full ? "disk_full" : "storage",
                  error_text(status.error())};
}

double now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

void check_name(const std::string& name) {
    constexpr size_t kLongest = 200;
    const bool is_plain = std::ranges::none_of(name, [](char c) {
        return static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '/' || c == '\\';
    });
    const bool is_dots = name == "." || name == "..";
    if (is_plain && !is_dots && name.size() <= kLongest && is_utf8(name) && !is_id(name)) return;
    throw Problem{400, "invalid_value",
                  "name: is not a name: at most 200 bytes without slashes and control characters, "
                  "and no id",
                  "name", name.substr(0, kLongest)};
}

Json to_json(const StoredFile& file) {
    Json json{{"id", file.id},           {"name", file.names.empty() ? "" : *file.names.begin()},
              {"names", file.names},     {"bytes", file.bytes},
              {"created", file.created}, {"state", file.damage.empty() ? "ready" : "quarantined"}};
    if (!file.damage.empty()) json["damage"] = file.damage;
    return json;
}

Json to_json_with_facts(const StoredFile& file) {
    Json json = to_json(file);
    json["facts"] = object_in(file.facts);
    return json;
}

Store::Store(const Settings& settings, Log& log, Metrics& metrics)
    : settings_(settings), log_(log), metrics_(metrics) {}

Result<std::unique_ptr<Store>> Store::open(const Settings& settings, Log& log, Metrics& metrics) {
    std::unique_ptr<Store> store(new Store(settings, log, metrics));
    if (settings.is_read_only) {
        if (!fs::is_directory(settings.data)) {
            return Error{settings.data + ": is no folder"};
        }
        store->read_index_now_and_then();
        if (metrics.damaged_indexes > 0) return Error{store->index_path() + ": is damaged"};
        return store;
    }
    remove_all(settings.data + "/work");
    for (const char* folder :
         {"scenes", "skies", "groups", "volumes", "bakes", "work", "quarantine"}) {
        auto status = make_folder(settings.data + "/" + folder);
        if (!status) return status.error();
    }
    drop_reserve(store->reserve_path());
    if (auto status = store->open_database(); !status) return status.error();
    try {
        store->adopt_or_drop_unknown_files();
    } catch (const Problem& problem) {
        return Error{settings.data + ": " + problem.detail};
    }
    store->write_index();
    return store;
}

void Store::report(const std::string& finding) {
    findings_.push_back(finding);
    log_.write(Log::Level::Error, finding);
}

/// A damaged database is put aside, and a new one takes its place.
Status Store::open_database() {
    const std::string path = settings_.data + "/tetralight.db";
    is_database_new_ = !fs::exists(path);
    for (int attempt = 0; attempt < 2; ++attempt) {
        auto opened = Database::open(path);
        std::string reason = opened ? "" : error_text(opened.error());
        if (opened) {
            database_.emplace(std::move(*opened));
            try {
                load();
                return Ok{};
            } catch (const Problem& problem) {
                reason = problem.detail;
            } catch (const std::exception& exception) {
                reason = str_cat("is damaged (", exception.what(), ")");
            }
        }
        database_.reset();
        const bool is_damaged = reason.find("damaged") != std::string::npos ||
                                reason.find("malformed") != std::string::npos ||
                                reason.find("not a database") != std::string::npos;
        if (!is_damaged || attempt > 0) return Error{reason};
        const std::string stamp = std::to_string(static_cast<int64_t>(now()));
        for (const char* suffix : {"", "-wal", "-shm"}) {
            std::error_code ignored;
            fs::rename(path + suffix,
                       settings_.data + "/quarantine/" + stamp + "-tetralight.db" + suffix,
                       ignored);
        }
        ++metrics_.quarantined;
        report(
            "the database was damaged and is in quarantine; files were indexed anew, bakes that "
            "were not over are lost (" +
            reason + ")");
        is_database_new_ = true;
    }
    return Ok{};
}

void Store::load() {
    for (Files& all : files_) all.clear();
    for (const auto& row :
         database_->run("SELECT id, kind, bytes, created, facts, damage FROM files")) {
        StoredFile file;
        file.id = std::get<std::string>(row[0]);
        file.kind = kind_of(std::get<std::string>(row[1])).value();
        file.bytes = static_cast<uint64_t>(std::get<int64_t>(row[2]));
        file.created = std::get<double>(row[3]);
        file.facts = std::get<std::string>(row[4]);
        file.damage = std::get<std::string>(row[5]);
        files(file.kind)[file.id] = std::move(file);
    }
    for (const auto& row : database_->run("SELECT kind, name, file FROM names")) {
        const Kind kind = kind_of(std::get<std::string>(row[0])).value();
        files(kind).at(std::get<std::string>(row[2])).names.insert(std::get<std::string>(row[1]));
    }
    index_names_locked();
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

/// Files without a row: what was never acknowledged, or, of a new database, all.
void Store::adopt_or_drop_unknown_files() {
    const auto bytes = read_file(index_path());
    const Index index = is_database_new_ && bytes ? parse_index(*bytes) : Index();
    for (const Kind kind : kKinds) {
        std::map<std::string, fs::path> present;
        for (const auto& entry : fs::directory_iterator(settings_.data + "/" + name_of(kind))) {
            present[entry.path().stem().string()] = entry.path();
        }
        for (auto& [id, file] : files(kind)) {
            if (!file.damage.empty() || present.contains(id)) continue;
            quarantine(kind, id, "the file is missing");
            report(str_cat(name_of(kind), "/", id, " is missing"));
        }
        for (const auto& [id, path] : present) {
            if (files(kind).contains(id)) continue;
            if (!is_database_new_ || !is_id(id)) {
                remove_all(path.string());
                continue;
            }
            StoredFile file;
            const auto known = index.files.find(str_cat(name_of(kind), "/", id));
            if (known != index.files.end()) file = known->second;
            file.kind = kind;
            file.id = id;
            file.bytes = fs::file_size(path);
            if (file.created == 0.0) file.created = now();
            insert(file);
        }
    }
}

const StoredFile* Store::find_locked(Kind kind, const std::string& reference) {
    const Files& all = files(kind);
    if (const auto found = all.find(reference); found != all.end()) return &found->second;
    const auto& names = id_of_name_[static_cast<size_t>(kind)];
    const auto named = names.find(reference);
    return named == names.end() ? nullptr : &all.at(named->second);
}

std::optional<StoredFile> Store::find(Kind kind, const std::string& reference) {
    if (is_read_only()) read_index_now_and_then();
    const std::shared_lock lock(mutex_);
    const StoredFile* file = find_locked(kind, reference);
    return file == nullptr ? std::nullopt : std::optional(*file);
}

StoredFile Store::get(Kind kind, const std::string& reference) {
    auto file = find(kind, reference);
    if (!file) {
        throw Problem{404, "not_found",
                      str_cat(kind == Kind::Groups ? "there are no such " : "there is no such ",
                              noun_of(kind)),
                      noun_of(kind), reference.substr(0, 200)};
    }
    if (!file->damage.empty()) {
        throw Problem{410, "quarantined",
                      str_cat("the ", noun_of(kind), " is damaged: ", file->damage), noun_of(kind),
                      file->id};
    }
    return std::move(*file);
}

std::vector<StoredFile> Store::list(Kind kind) {
    if (is_read_only()) read_index_now_and_then();
    const std::shared_lock lock(mutex_);
    std::vector<StoredFile> all;
    for (const auto& [id, file] : files(kind)) all.push_back(file);
    return all;
}

/// Rows and memory; names leave the files that had them.
void Store::insert(const StoredFile& file) {
    const std::string kind = name_of(file.kind);
    database_->transaction([&] {
        database_->run(
            "INSERT OR REPLACE INTO files (id, kind, bytes, created, facts, damage) "
            "VALUES (?, ?, ?, ?, ?, ?)",
            {file.id, kind, static_cast<int64_t>(file.bytes), file.created, file.facts,
             file.damage});
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

Store::Added Store::add(Kind kind, const std::string& from, const std::string& name,
                        const Json& facts) {
    check_name(name);
    const std::lock_guard change(change_mutex_);
    StoredFile file;
    {
        const MappedFile mapping = map(from);
        file.id = id_of(mapping.bytes());
        file.bytes = mapping.bytes().size();
    }
    const auto known = find(kind, file.id);
    const bool is_new = !known || !known->damage.empty();
    if (is_new) {
        check_quota(file.bytes);
        require_stored(move_synced(from, path(kind, file.id)));
        file.kind = kind;
        file.created = now();
        file.facts = dump(facts);
        if (known) file.names = known->names;
    } else {
        file = *known;
    }
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

StoredFile Store::rename(Kind kind, const std::string& reference, const std::string& name) {
    check_name(name);
    const std::lock_guard change(change_mutex_);
    StoredFile file = get(kind, reference);
    if (!is_id(reference)) file.names.erase(reference);
    if (is_id(reference) && name.empty()) file.names.clear();
    if (!name.empty()) file.names.insert(name);
    insert(file);
    write_index();
    return file;
}

void Store::remove(Kind kind, const std::string& reference) {
    const std::lock_guard change(change_mutex_);
    auto file = find(kind, reference);
    if (!file) (void)get(kind, reference);  // throws
    if (!is_id(reference) && file->names.size() > 1) {
        file->names.erase(reference);
        with_reserve([&] { insert(*file); });
        write_index();
        return;
    }
    with_reserve([&] {
        database_->run("DELETE FROM files WHERE kind = ? AND id = ?",
                       {std::string(name_of(kind)), file->id});
    });
    {
        const std::unique_lock lock(mutex_);
        files(kind).erase(file->id);
        index_names_locked();
    }
    const bool is_index_written = write_index();
    remove_all(path(kind, file->id));
    if (!is_index_written) write_index();
    keep_reserve();
}

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
    std::error_code ignored;
    fs::rename(path(kind, id),
               settings_.data + "/quarantine/" + name_of(kind) + "-" + id + extension_of(kind),
               ignored);
}

void Store::link(const StoredFile& file, const std::string& to) {
    const std::string from = path(file.kind, file.id);
    if (id_of(map(from).bytes()) != file.id) {
        quarantine(file.kind, file.id, "its bytes are not those that came in");
        (void)get(file.kind, file.id);  // throws
    }
    if (::link(from.c_str(), to.c_str()) != 0) require_stored(system_error(to, "link"));
}

std::string Store::path(Kind kind, const std::string& id) const {
    return settings_.data + "/" + name_of(kind) + "/" + id + extension_of(kind);
}

std::string Store::bake_folder(const std::string& id) const {
    return settings_.data + "/bakes/" + id;
}

WorkFolder Store::make_work_folder() {
    const std::string folder = str_cat(settings_.data, "/work/", ++work_count_);
    require_stored(make_folder(folder));
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

/// For servers that only read, and for the day on which the database is damaged. What is stored is
/// stored without it: when it cannot be written, the next change brings it up to date.
bool Store::write_index() {
    Json json = Json::array();
    {
        const std::shared_lock lock(mutex_);
        for (const Files& all : files_) {
            for (const auto& [id, file] : all) {
                Json entry = to_json(file);
                entry["kind"] = name_of(file.kind);
                entry["facts"] = object_in(file.facts);
                json.push_back(std::move(entry));
            }
        }
    }
    const std::string bytes = dump({{"files", json}});
    const auto write = [&] {
        require_stored(write_file(index_path(), std::as_bytes(std::span(bytes))));
    };
    try {
        with_reserve(write);
        keep_reserve();
        return true;
    } catch (const Problem& problem) {
        log_.write(Log::Level::Error, "readers do not see the last changes",
                   {{"error", problem.detail}});
        return false;
    }
}

/// Once a second at most, and only when it changed. A damaged one changes nothing.
void Store::read_index_now_and_then() {
    const auto ticks = std::chrono::steady_clock::now().time_since_epoch().count();
    int64_t next = next_index_check_;
    constexpr int64_t kSecond = 1'000'000'000;
    if (ticks < next || !next_index_check_.compare_exchange_strong(next, ticks + kSecond)) return;
    struct stat status = {};
    if (::stat(index_path().c_str(), &status) != 0) return;
    std::string stamp = str_cat(status.st_ino, " ", status.st_mtim.tv_sec, " ",
                                status.st_mtim.tv_nsec, " ", status.st_size);
    const std::lock_guard change(change_mutex_);
    if (stamp == index_stamp_) return;
    const auto bytes = read_file(index_path());
    if (!bytes) return;  // it may be there in a second
    index_stamp_ = std::move(stamp);
    const Index index = parse_index(*bytes);
    if (!index.is_whole) {
        ++metrics_.damaged_indexes;
        log_.write(Log::Level::Error, "index.json is damaged; what it said before is served");
        return;
    }
    const std::unique_lock lock(mutex_);
    for (Files& all : files_) all.clear();
    for (const auto& [key, file] : index.files) files(file.kind)[file.id] = file;
    index_names_locked();
}

}  // namespace tetralight::server
