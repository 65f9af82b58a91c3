// SPDX-License-Identifier: Apache-2.0
#include "server/store.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "base/file.h"
#include "base/text.h"
#include "base/utf8.h"
#include "server/problem.h"

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
    if (!file) throw Problem{500, "storage", file.error().message};
    return std::move(*file);
}

void require(const Status& status) {
    if (status) return;
    const bool is_full = status.error().message.find("No space left") != std::string::npos;
    throw Problem{is_full ? 507u : 500u, is_full ? "disk_full" : "storage", status.error().message};
}

Json parse_or_empty(const std::string& text) {
    Json json = Json::parse(text, nullptr, false);
    return json.is_discarded() ? Json::object() : json;
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

double now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

void check_name(const std::string& name) {
    constexpr size_t kLongest = 200;
    const bool is_plain = std::ranges::none_of(name, [](char c) {
        return static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '/' || c == '\\';
    });
    if (is_plain && name.size() <= kLongest && is_utf8(name) && !is_id(name)) return;
    throw Problem{400, "invalid_value",
                  "name: is not a name: at most 200 bytes without slashes and control characters, "
                  "and no id",
                  "name", name.substr(0, kLongest)};
}

Json to_json(const StoredFile& file) {
    Json json{{"id", file.id},
              {"name", file.name},
              {"bytes", file.bytes},
              {"created", file.created},
              {"state", file.damage.empty() ? "ready" : "quarantined"}};
    if (!file.damage.empty()) json["damage"] = file.damage;
    return json;
}

Json to_json_with_facts(const StoredFile& file) {
    Json json = to_json(file);
    json["facts"] = parse_or_empty(file.facts);
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
        return store;
    }
    remove_all(settings.data + "/work");
    for (const char* folder :
         {"scenes", "skies", "groups", "volumes", "bakes", "work", "quarantine"}) {
        auto status = make_folder(settings.data + "/" + folder);
        if (!status) return status.error();
    }
    if (auto status = store->open_database(); !status) return status.error();
    try {
        store->adopt_or_drop_unknown_files();
        store->write_index();
    } catch (const Problem& problem) {
        return Error{settings.data + ": " + problem.detail};
    }
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
        std::string reason = opened ? "" : opened.error().message;
        if (opened) {
            database_.emplace(std::move(*opened));
            try {
                load();
                return Ok{};
            } catch (const Problem& problem) {
                reason = problem.detail;
            } catch (const std::exception& exception) {
                reason = exception.what();
            }
        }
        database_.reset();
        const bool is_damaged = reason.find("damaged") != std::string::npos ||
                                reason.find("malformed") != std::string::npos ||
                                reason.find("not a database") != std::string::npos ||
                                reason.find("bad_variant") != std::string::npos;
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
    for (const auto& row : database_->run(
             "SELECT id, kind, name, bytes, created, facts, damage FROM files ORDER BY rowid")) {
        StoredFile file;
        file.id = std::get<std::string>(row[0]);
        const auto kind = std::ranges::find(kKindNames, std::get<std::string>(row[1]));
        file.kind = static_cast<Kind>(kind - std::begin(kKindNames));
        file.name = std::get<std::string>(row[2]);
        file.bytes = static_cast<uint64_t>(std::get<int64_t>(row[3]));
        file.created = std::get<double>(row[4]);
        file.facts = std::get<std::string>(row[5]);
        file.damage = std::get<std::string>(row[6]);
        files(file.kind)[file.id] = std::move(file);
    }
    index_names_locked();
}

void Store::index_names_locked() {
    for (const Kind kind : kKinds) {
        auto& names = id_of_name_[static_cast<size_t>(kind)];
        names.clear();
        for (const auto& [id, file] : files(kind)) {
            if (!file.name.empty()) names[file.name] = id;
        }
    }
}

/// Files without a row: what was never acknowledged, or, of a new database, all.
void Store::adopt_or_drop_unknown_files() {
    const auto index = is_database_new_ ? read_index() : std::map<std::string, StoredFile>();
    for (const Kind kind : kKinds) {
        std::map<std::string, fs::path> present;
        for (const auto& entry : fs::directory_iterator(settings_.data + "/" + name_of(kind))) {
            present[entry.path().stem().string()] = entry.path();
        }
        for (auto& [id, file] : files(kind)) {
            if (!file.damage.empty() || present.contains(id)) continue;
            quarantine(kind, id, "the file is missing");
            report(text(name_of(kind), "/", id, " is missing"));
        }
        for (const auto& [id, path] : present) {
            if (files(kind).contains(id)) continue;
            if (!is_database_new_ || !is_id(id)) {
                remove_all(path.string());
                continue;
            }
            StoredFile file;
            const auto known = index.find(std::string(name_of(kind)) + "/" + id);
            if (known != index.end()) file = known->second;
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
        throw Problem{404, "not_found", text("there is no such ", noun_of(kind)), noun_of(kind),
                      reference.substr(0, 200)};
    }
    if (!file->damage.empty()) {
        throw Problem{410, "quarantined",
                      text("the ", noun_of(kind), " is damaged: ", file->damage), noun_of(kind),
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

/// Row and memory; a name leaves the file that had it.
void Store::insert(const StoredFile& file) {
    database_->transaction([&] {
        if (!file.name.empty()) {
            database_->run("UPDATE files SET name = '' WHERE kind = ? AND name = ?",
                           {std::string(name_of(file.kind)), file.name});
        }
        database_->run(
            "INSERT OR REPLACE INTO files (id, kind, name, bytes, created, facts, damage) "
            "VALUES (?, ?, ?, ?, ?, ?, ?)",
            {file.id, std::string(name_of(file.kind)), file.name, static_cast<int64_t>(file.bytes),
             file.created, file.facts, file.damage});
    });
    const std::unique_lock lock(mutex_);
    for (auto& [id, other] : files(file.kind)) {
        if (!file.name.empty() && other.name == file.name) other.name.clear();
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
    auto known = find(kind, file.id);
    const bool is_new = !known || !known->damage.empty();
    if (is_new) {
        check_quota(file.bytes);
        require(move_synced(from, path(kind, file.id)));
        file.kind = kind;
        file.created = now();
        file.facts = dump(facts);
    } else {
        file = *known;
    }
    if (!name.empty()) file.name = name;
    if (is_new || file.name != known->name) {
        insert(file);
        write_index();
    }
    return {file, is_new};
}

StoredFile Store::rename(Kind kind, const std::string& reference, const std::string& name) {
    check_name(name);
    const std::lock_guard change(change_mutex_);
    StoredFile file = get(kind, reference);
    file.name = name;
    insert(file);
    write_index();
    return file;
}

void Store::remove(Kind kind, const std::string& reference) {
    const std::lock_guard change(change_mutex_);
    const auto file = find(kind, reference);
    if (!file) (void)get(kind, reference);  // throws
    database_->run("DELETE FROM files WHERE kind = ? AND id = ?",
                   {std::string(name_of(kind)), file->id});
    {
        const std::unique_lock lock(mutex_);
        files(kind).erase(file->id);
        index_names_locked();
    }
    write_index();
    remove_all(path(kind, file->id));
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
    database_->run("UPDATE files SET damage = ? WHERE kind = ? AND id = ?",
                   {damage, std::string(name_of(kind)), id});
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
    if (::link(from.c_str(), to.c_str()) != 0) require(system_error(to, "link"));
}

std::string Store::path(Kind kind, const std::string& id) const {
    return settings_.data + "/" + name_of(kind) + "/" + id + extension_of(kind);
}

std::string Store::bake_folder(const std::string& id) const {
    return settings_.data + "/bakes/" + id;
}

WorkFolder Store::make_work_folder() {
    const std::string folder = text(settings_.data, "/work/", ++work_count_);
    require(make_folder(folder));
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
    throw Problem{507, "quota", text("the store may hold ", settings_.quota_bytes, " bytes"), "",
                  std::to_string(more)};
}

/// For servers that only read, and for the day on which the database is damaged.
void Store::write_index() {
    Json json = Json::array();
    {
        const std::shared_lock lock(mutex_);
        for (const Files& all : files_) {
            for (const auto& [id, file] : all) {
                Json entry = to_json(file);
                entry["kind"] = name_of(file.kind);
                entry["facts"] = parse_or_empty(file.facts);
                json.push_back(std::move(entry));
            }
        }
    }
    const std::string bytes = dump({{"files", json}});
    require(write_file(settings_.data + "/index.json", std::as_bytes(std::span(bytes))));
}

std::map<std::string, StoredFile> Store::read_index() const {
    std::map<std::string, StoredFile> index;
    const auto bytes = read_file(settings_.data + "/index.json");
    if (!bytes) return index;
    const Json json =
        Json::parse(reinterpret_cast<const char*>(bytes->data()),
                    reinterpret_cast<const char*>(bytes->data() + bytes->size()), nullptr, false);
    if (!json.is_object() || !json.contains("files")) return index;
    for (const Json& entry : json["files"]) {
        try {
            StoredFile file;
            const auto kind = std::ranges::find(kKindNames, entry.at("kind").get<std::string>());
            if (kind == std::end(kKindNames)) continue;
            file.kind = static_cast<Kind>(kind - std::begin(kKindNames));
            file.id = entry.at("id");
            file.name = entry.at("name");
            file.bytes = entry.at("bytes");
            file.created = entry.at("created");
            file.damage = entry.value("damage", "");
            file.facts = dump(entry.at("facts"));
            if (!is_id(file.id)) continue;
            index[std::string(*kind) + "/" + file.id] = std::move(file);
        } catch (const Json::exception&) {
            continue;  // the rest may be whole
        }
    }
    return index;
}

/// Once a second at most, and only when it changed.
void Store::read_index_now_and_then() {
    const auto ticks = std::chrono::steady_clock::now().time_since_epoch().count();
    int64_t next = next_index_check_;
    constexpr int64_t kSecond = 1'000'000'000;
    if (ticks < next || !next_index_check_.compare_exchange_strong(next, ticks + kSecond)) return;
    struct stat status = {};
    if (::stat((settings_.data + "/index.json").c_str(), &status) != 0) return;
    std::string stamp = text(status.st_ino, " ", status.st_mtim.tv_sec, " ", status.st_mtim.tv_nsec,
                             " ", status.st_size);
    const std::lock_guard change(change_mutex_);
    if (stamp == index_stamp_) return;
    const auto index = read_index();
    const std::unique_lock lock(mutex_);
    for (Files& all : files_) all.clear();
    for (const auto& [key, file] : index) files(file.kind)[file.id] = file;
    index_names_locked();
    index_stamp_ = std::move(stamp);
}

}  // namespace tetralight::server
