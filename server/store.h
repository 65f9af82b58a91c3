// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/server/database.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/file_stamp.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/json.h>
#include <tetralight/server/log.h>
#include <tetralight/server/metrics.h>
#include <tetralight/server/periodic.h>
#include <tetralight/server/settings.h>
#include <tetralight/server/store_index.h>
#include <tetralight/server/stored_file.h>

namespace tetralight::server {

/// The data folder of a server:
///
///     DIR/tetralight.db                names, facts and bakes
///     DIR/index.json                   the stored files, for servers that only read
///     DIR/{scenes,skies,groups,volumes,lightmaps,reflections}/ID.EXT
///     DIR/bakes/ID/                    an unfinished bake
///     DIR/work/                        folders of requests; deleted at the start
///     DIR/quarantine/                  damaged files, and those that no row tells of
///     DIR/reserve                      space that deleting needs when the disk is full
///
/// A file is written before its row and deleted after it, so that every file that the database
/// names exists. Only corrupt files are put into the quarantine: a file that is missing or cannot
/// be read for now is a 503 until it can. Thread-safe. Functions without a `Result` throw a
/// `Problem`.
class Store {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Store>> open(const Settings& settings, Log& log,
                                                             Metrics& metrics);

    /// By id or by name. Throws 404 if there is none, 410 if it is damaged.
    [[nodiscard]] StoredFile get(Kind kind, const std::string& reference);
    [[nodiscard]] std::optional<StoredFile> find(Kind kind, const std::string& reference);
    [[nodiscard]] std::vector<StoredFile> list(Kind kind);

    struct Added {
        StoredFile file;
        bool is_new = false;
    };

    /// Moves a file on the store's disk into the store. A name moves to it from the file that had
    /// it, in addition to its other names.
    Added add(Kind kind, const std::string& path, const std::string& name, const Json& facts);
    /// Called with a file before it is changed, while nothing else changes it; throws to refuse.
    using Condition = std::function<void(const StoredFile&)>;

    /// By name: replaces the name. By id: adds the name to the file's names. An empty name removes
    /// the name; by id, all names.
    StoredFile rename(Kind kind, const std::string& reference, const std::string& name,
                      const Condition& condition = {});
    /// By name: removes the name, and with its last name the file. By id: removes the file.
    void remove(Kind kind, const std::string& reference, const Condition& condition = {});

    /// Removes a file that has no name. Returns false, and changes nothing, if it has one by now.
    bool remove_unnamed(Kind kind, const std::string& id);

    /// Moves a damaged file to the quarantine.
    void quarantine(Kind kind, const std::string& id, const std::string& damage);

    /// Moves a file or folder of the data folder to the quarantine, under this name or, if there is
    /// one of this name, with a number before it. Returns false if the system refuses.
    bool put_aside(const std::string& from, const std::string& name) const;

    /// Moves a file back to its place and serves it, with the names that it had. Throws a
    /// `Problem`: 422 if its bytes do not have its id.
    StoredFile take_back(Kind kind, const std::string& id, const std::string& from);

    /// Deletes an entry of the quarantine. Throws if the system refuses.
    void remove_quarantined(const std::string& name);

    [[nodiscard]] std::string quarantine_folder() const { return settings_.data + "/quarantine/"; }

    /// Tells the operator of damage that was found at the start.
    void report(const std::string& finding);

    /// Links a file into a folder on the store's disk, where it stays even if the store deletes it.
    /// Throws if its bytes do not have its id.
    void link(const StoredFile& file, const std::string& path);

    [[nodiscard]] std::string path(Kind kind, const std::string& id) const;
    [[nodiscard]] std::string bake_folder(const std::string& id) const;
    [[nodiscard]] WorkFolder make_work_folder();

    /// Throws if `more` bytes do not fit the quota.
    void check_quota(uint64_t more) const;
    [[nodiscard]] uint64_t total_bytes() const;

    [[nodiscard]] Database& database() { return *database_; }

    /// Runs `work`, which frees space or ends a bake. If the disk is full, releases the reserve and
    /// runs it once more.
    void with_reserve(const std::function<void()>& work);
    /// Fills the reserve up again. Call it after space was freed.
    void keep_reserve() const;

    [[nodiscard]] const Settings& settings() const { return settings_; }

    [[nodiscard]] bool is_read_only() const { return settings_.is_read_only; }

    /// Damage that was found at the start.
    [[nodiscard]] const std::vector<std::string>& findings() const { return findings_; }

  private:
    using Files = std::map<std::string, StoredFile>;  ///< by id

    [[nodiscard]] std::string index_path() const { return settings_.data + "/index.json"; }

    [[nodiscard]] std::string reserve_path() const { return settings_.data + "/reserve"; }

    Store(const Settings& settings, Log& log, Metrics& metrics);

    [[nodiscard]] Status open_database();
    void load();
    [[nodiscard]] Status try_database(const std::string& path);
    void quarantine_database(const std::string& path, const Error& error);
    void clear_work();
    void match_files();
    void match_files_of(Kind kind, const StoreIndex& index);
    void heal(StoredFile file);
    void take_in(Kind kind, const std::string& name, const StoreIndex& index);
    [[nodiscard]] bool is_deleted(Kind kind, const std::string& id, const std::string& path);
    void adopt(Kind kind, const std::string& id, uint64_t bytes, const StoreIndex& index);
    void forget_deleted(Kind kind);

    [[nodiscard]] Files& files(Kind kind) { return files_[static_cast<size_t>(kind)]; }

    [[nodiscard]] const StoredFile* find_locked(Kind kind, const std::string& reference);
    [[nodiscard]] std::optional<StoredFile> find_bytes(Kind kind, const std::string& from,
                                                       const FileIds& ids);
    void remove_locked(const StoredFile& file);
    void drop_row(const StoredFile& file);
    void insert(const StoredFile& file);
    void index_names_locked();
    bool write_index();
    void read_index_if_changed();

    const Settings settings_;
    Log& log_;
    Metrics& metrics_;
    std::optional<Database> database_;
    std::vector<std::string> findings_;
    mutable std::shared_mutex mutex_;
    Files files_[std::size(kKinds)];
    std::map<std::string, std::string> id_of_name_[std::size(kKinds)];
    std::mutex change_mutex_;  ///< one change at a time, with its file, row and index
    std::atomic<uint64_t> work_count_ = 0;
    std::optional<FileStamp> index_stamp_;
    Periodic periodic_;  ///< reads the index of another server
};

/// Seconds since 1970.
[[nodiscard]] double now();

}  // namespace tetralight::server
