// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The name of a value: SHA-256 of everything that the value depends on.
using StoreKey = Sha256Digest;

struct StoreEntry {
    StoreKey key{};
    std::span<const std::byte> value;
};

/// Sizes of a store's packs in bytes, after the least recently used ones were deleted.
struct StoreSize {
    uint64_t kept = 0;
    uint64_t deleted = 0;
};

/// A folder of results that are expensive to compute: key → bytes. Entries are kept in pack files.
/// Each `put` writes one new pack, syncs it and renames it into place; packs never change after
/// that, so several processes can use one folder at the same time. Each entry has a checksum.
///
///     auto store = BakeStore::open("cache");
///     if (const auto value = store->find(key)) ... else ... store->put({{key, bytes}});
class BakeStore {
  public:
    /// Reads the tables of all packs. The folder may not exist; the first `put` makes it. Entries
    /// that other processes put later are not seen. Returns invalid_argument if the path is not a
    /// folder, or a folder of other files.
    [[nodiscard]] static Result<BakeStore> open(const std::string& folder);

    /// True if the path is a folder that holds a store.
    [[nodiscard]] static bool is_store(const std::string& folder);

    /// Removes the files of a store, and the folder if nothing else is in it.
    static void remove(const std::string& folder);

    /// The newest undamaged value of a key. Valid until the next `put` or `prune`.
    [[nodiscard]] std::optional<std::span<const std::byte>> find(const StoreKey& key);

    /// Adds entries; they replace earlier ones of the same keys. After it returns they survive a
    /// crash of the system.
    [[nodiscard]] Status put(std::span<const StoreEntry> entries);

    /// Deletes the least recently used packs until all packs together have at most `max_bytes`.
    /// Packs that cannot be deleted stay.
    StoreSize prune(uint64_t max_bytes);

    /// Damaged packs and entries met so far.
    [[nodiscard]] size_t damaged_count() const { return damaged_count_; }

    /// True if it has no entries.
    [[nodiscard]] bool is_empty() const { return locations_.empty(); }

    [[nodiscard]] const std::string& folder() const { return folder_; }

  private:
    struct Pack {
        std::string path;
        MappedFile file;
        bool is_used = false;  ///< its time of last use has been set
    };

    struct Location {
        StoreKey key;
        uint32_t pack = 0;  ///< later packs are newer
        uint64_t offset = 0;
        uint64_t size = 0;
        uint64_t checksum = 0;
    };

    explicit BakeStore(std::string folder) : folder_(std::move(folder)) {}

    void add_packs();
    void add_pack(const std::string& path);
    void sort_locations(size_t sorted_count);
    [[nodiscard]] std::span<const std::byte> value_at(const Location& location) const;
    [[nodiscard]] Status make_folder() const;
    Result<std::string> write_pack(std::span<const StoreEntry> entries);
    Status merge_own_packs();

    std::string folder_;
    std::vector<Pack> packs_;
    std::vector<Location> locations_;  ///< by key, newest first
    std::vector<uint32_t> own_packs_;  ///< written by this object
    uint64_t next_number_ = 0;         ///< of the next pack
    size_t damaged_count_ = 0;
};

}  // namespace tetralight
