// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <shared_mutex>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/server/database.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/json.h>
#include <tetralight/server/log.h>
#include <tetralight/server/metrics.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

enum class Kind : uint8_t { Scenes, Skies, Groups, Volumes };

inline constexpr Kind kKinds[] = {Kind::Scenes, Kind::Skies, Kind::Groups, Kind::Volumes};

/// "scenes": its folder and its part of paths.
[[nodiscard]] const char* name_of(Kind kind);
/// "scene".
[[nodiscard]] const char* noun_of(Kind kind);
/// ".glb".
[[nodiscard]] const char* extension_of(Kind kind);

/// One file of the store. It never changes; its names can.
struct StoredFile {
    Kind kind = Kind::Scenes;
    /// The hash of its bytes (XXH128), 32 hexadecimal digits.
    std::string id;
    /// Each leads to one file of its kind; the same bytes may have come in under several.
    std::set<std::string> names;
    uint64_t bytes = 0;
    /// Seconds since 1970.
    double created = 0.0;
    /// What was found out when it came in: a JSON object, as text since files are copied often.
    std::string facts = "{}";
    /// Why it cannot be used; empty: it can.
    std::string damage;
};

/// Without its facts.
[[nodiscard]] Json to_json(const StoredFile& file);
[[nodiscard]] Json to_json_with_facts(const StoredFile& file);

/// All that a server keeps:
///
///     DIR/tetralight.db                names, facts and bakes
///     DIR/index.json                   the same of files, for servers that only read
///     DIR/{scenes,skies,groups,volumes}/ID.EXT
///     DIR/bakes/ID/                    a bake that is not over
///     DIR/work/                        what requests work in; emptied at the start
///     DIR/quarantine/                  what turned out to be damaged
///     DIR/reserve                      space to delete with when the disk is full
///
/// A file is on the disk before its row, and a row is gone before its file, so that whatever the
/// database names is there. Thread-safe. Functions without a `Result` throw a `Problem`.
class Store {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Store>> open(const Settings& settings, Log& log,
                                                             Metrics& metrics);

    /// By id or by name. Throws: there is none (404), or it is damaged (410).
    [[nodiscard]] StoredFile get(Kind kind, const std::string& reference);
    [[nodiscard]] std::optional<StoredFile> find(Kind kind, const std::string& reference);
    [[nodiscard]] std::vector<StoredFile> list(Kind kind);

    struct Added {
        StoredFile file;
        bool is_new = false;
    };

    /// Takes a file of the store's disk over. A name moves to it from the file that had it, and
    /// stands beside those that it has.
    Added add(Kind kind, const std::string& path, const std::string& name, const Json& facts);
    /// By name: the name becomes the new one. By id: the file gets the name beside those it has.
    /// No name: that name goes; by id, all of them.
    StoredFile rename(Kind kind, const std::string& reference, const std::string& name);
    /// By name: the name goes, and the file with its last name. By id: all of it.
    void remove(Kind kind, const std::string& reference);

    /// Puts a damaged file aside.
    void quarantine(Kind kind, const std::string& id, const std::string& damage);

    /// Links a file into a folder of the store's disk, where it stays whatever becomes of it here.
    /// Throws when its bytes are not those that its id says.
    void link(const StoredFile& file, const std::string& path);

    [[nodiscard]] std::string path(Kind kind, const std::string& id) const;
    [[nodiscard]] std::string bake_folder(const std::string& id) const;
    [[nodiscard]] WorkFolder make_work_folder();

    /// Throws when so many bytes more would be over the quota.
    void check_quota(uint64_t more) const;
    [[nodiscard]] uint64_t total_bytes() const;

    [[nodiscard]] Database& database() { return *database_; }

    /// Does what frees space or ends something: when the disk is full, once more with the space
    /// that is kept for that.
    void with_reserve(const std::function<void()>& work);
    /// To be called after something was freed.
    void keep_reserve() const;

    [[nodiscard]] bool is_read_only() const { return settings_.is_read_only; }

    /// What was wrong at the start.
    [[nodiscard]] const std::vector<std::string>& findings() const { return findings_; }

  private:
    using Files = std::map<std::string, StoredFile>;  ///< by id

    [[nodiscard]] std::string index_path() const { return settings_.data + "/index.json"; }

    [[nodiscard]] std::string reserve_path() const { return settings_.data + "/reserve"; }

    Store(const Settings& settings, Log& log, Metrics& metrics);

    [[nodiscard]] Status open_database();
    void load();
    void adopt_or_drop_unknown_files();

    [[nodiscard]] Files& files(Kind kind) { return files_[static_cast<size_t>(kind)]; }

    [[nodiscard]] const StoredFile* find_locked(Kind kind, const std::string& reference);
    void insert(const StoredFile& file);
    void index_names_locked();
    bool write_index();
    void read_index_now_and_then();
    void report(const std::string& finding);

    const Settings settings_;
    Log& log_;
    Metrics& metrics_;
    std::optional<Database> database_;
    bool is_database_new_ = false;
    std::vector<std::string> findings_;
    mutable std::shared_mutex mutex_;
    Files files_[std::size(kKinds)];
    std::map<std::string, std::string> id_of_name_[std::size(kKinds)];
    std::mutex change_mutex_;  ///< one change at a time, from the disk to the index
    std::atomic<uint64_t> work_count_ = 0;
    std::atomic<int64_t> next_index_check_ = 0;
    std::string index_stamp_;
};

/// Throws a `Problem` when the disk did not do it: 507 when it is full.
void require_stored(const Status& status);

/// Throws a `Problem` unless it can be a name: at most 200 bytes of UTF-8 without control
/// characters and slashes, that is no id.
void check_name(const std::string& name);

/// Whether a text is an id: 32 hexadecimal digits.
[[nodiscard]] bool is_id(const std::string& text);

/// Seconds since 1970.
[[nodiscard]] double now();

}  // namespace tetralight::server
