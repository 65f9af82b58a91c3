// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_store.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <tuple>

#include <tetralight/base/file.h>
#include <tetralight/base/file_writer.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/probes/content_hash.h>

// A pack: PackHeader, `entry_count` × PackEntry, values one after the other. Its name is
// NUMBER-HASH.pack; packs with larger numbers are newer.

namespace tetralight {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kPackMagic = 0x31'4b'43'41'50'4c'54'54;  // "TTLPACK1"
constexpr const char* kMarker = "tetralight-store";         // marks the folder as a store
/// So many packs of one process are merged into one.
constexpr size_t kMaxOwnPacks = 32;

struct PackHeader {
    uint64_t magic = kPackMagic;
    uint64_t entry_count = 0;
    uint64_t table_checksum = 0;
};

struct PackEntry {
    StoreKey key{};
    uint64_t offset = 0;  ///< from the start of the file
    uint64_t size = 0;
    uint64_t checksum = 0;  ///< of the value
};

static_assert(sizeof(PackHeader) == 24 && sizeof(PackEntry) == 56);

uint64_t checksum_of(std::span<const std::byte> bytes) {
    ContentHash hash;
    hash.add_bytes(bytes);
    return hash.value();
}

bool is_pack(const fs::path& path) {
    return path.extension() == ".pack";
}

/// The files of a folder for which `is_one(path)` is true, in order.
template <class Test>
std::vector<std::string> paths_of(const std::string& folder, const Test& is_one) {
    std::vector<std::string> paths;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder, error)) {
        if (is_one(file.path())) paths.push_back(file.path().string());
    }
    std::ranges::sort(paths);
    return paths;
}

/// True for a file that a process was writing when it or the system stopped, see FileWriter.
bool is_unfinished(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.starts_with(std::string(kMarker) + ".") || name.find(".pack.") != name.npos;
}

/// True if a folder is empty but for what a stopped process left.
bool can_become_store(const std::string& folder) {
    std::error_code error;
    const fs::directory_iterator files(folder, error);
    return !error &&
           std::ranges::all_of(files, [](const auto& file) { return is_unfinished(file.path()); });
}

/// The table of a pack; nothing if it is damaged.
std::optional<std::vector<PackEntry>> read_table(std::span<const std::byte> bytes) {
    PackHeader header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    const size_t capacity = (bytes.size() - sizeof header) / sizeof(PackEntry);
    if (header.magic != kPackMagic || header.entry_count > capacity) return std::nullopt;
    std::vector<PackEntry> table(header.entry_count);
    const auto table_bytes = bytes.subspan(sizeof header, table.size() * sizeof(PackEntry));
    if (checksum_of(table_bytes) != header.table_checksum) return std::nullopt;
    if (!table.empty()) std::memcpy(table.data(), table_bytes.data(), table_bytes.size());
    return table;
}

}  // namespace

bool BakeStore::is_store(const std::string& folder) {
    std::error_code error;
    return fs::exists(fs::path(folder) / kMarker, error);
}

void BakeStore::remove(const std::string& folder) {
    std::error_code error;
    if (!is_store(folder)) return;
    const auto is_own = [](const fs::path& path) { return is_pack(path) || is_unfinished(path); };
    for (const std::string& path : paths_of(folder, is_own)) fs::remove(path, error);
    fs::remove(fs::path(folder) / kMarker, error);
    fs::remove(folder, error);
}

Result<BakeStore> BakeStore::open(const std::string& folder) {
    std::error_code error;
    const bool exists = fs::exists(folder, error);
    if (exists && !fs::is_directory(folder, error)) {
        return Error{ErrorCode::InvalidArgument,
                     folder + ": is not a bake store; move it away, or write elsewhere"};
    }
    if (exists && !is_store(folder) && !can_become_store(folder)) {
        return Error{ErrorCode::InvalidArgument,
                     folder + ": is a folder of other files, not a bake store"};
    }
    BakeStore store(folder);
    store.add_packs();
    return store;
}

void BakeStore::add_packs() {
    for (const std::string& path : paths_of(folder_, is_pack)) {
        unsigned long long number = 0;
        if (std::sscanf(fs::path(path).filename().c_str(), "%llx", &number) == 1) {
            next_number_ = std::max<uint64_t>(next_number_, number + 1);
        }
        add_pack(path);
    }
    sort_locations(0);
}

/// Adds the entries of a pack. Deletes it if its table is damaged. Another process may have deleted
/// it before.
void BakeStore::add_pack(const std::string& path) {
    std::error_code error;
    auto file = MappedFile::open(path);
    const auto table = file ? read_table(file->bytes()) : std::nullopt;
    if (!table) {
        if (fs::exists(path, error)) ++damaged_count_;
        if (file) fs::remove(path, error);
        return;
    }
    const uint64_t file_size = file->bytes().size();
    for (const PackEntry& entry : *table) {
        if (entry.offset > file_size || entry.size > file_size - entry.offset) {
            ++damaged_count_;
            continue;
        }
        locations_.push_back({entry.key, static_cast<uint32_t>(packs_.size()), entry.offset,
                              entry.size, entry.checksum});
    }
    packs_.push_back({path, std::move(*file)});
}

/// The first `sorted_count` locations are in order already.
void BakeStore::sort_locations(size_t sorted_count) {
    const auto is_before = [](const Location& a, const Location& b) {
        return std::tie(a.key, b.pack) < std::tie(b.key, a.pack);
    };
    const auto middle = locations_.begin() + static_cast<ptrdiff_t>(sorted_count);
    std::sort(middle, locations_.end(), is_before);
    std::inplace_merge(locations_.begin(), middle, locations_.end(), is_before);
}

std::span<const std::byte> BakeStore::value_at(const Location& location) const {
    return packs_[location.pack].file.bytes().subspan(location.offset, location.size);
}

std::optional<std::span<const std::byte>> BakeStore::find(const StoreKey& key) {
    auto at = std::ranges::lower_bound(locations_, key, {}, &Location::key);
    for (; at != locations_.end() && at->key == key; ++at) {
        Pack& pack = packs_[at->pack];
        const auto value = value_at(*at);
        if (checksum_of(value) != at->checksum) {
            ++damaged_count_;
            continue;
        }
        if (!pack.is_used) ::utimensat(AT_FDCWD, pack.path.c_str(), nullptr, 0);
        pack.is_used = true;
        return value;
    }
    return std::nullopt;
}

Status BakeStore::make_folder() const {
    if (is_store(folder_)) return Ok{};
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) {
        return Error{error_code_of_errno(error.value()),
                     folder_ + ": cannot make the folder (" + error.message() + ")"};
    }
    return write_file((fs::path(folder_) / kMarker).string(), std::span<const std::byte>());
}

Result<std::string> BakeStore::write_pack(std::span<const StoreEntry> entries) {
    std::vector<PackEntry> table;
    uint64_t offset = sizeof(PackHeader) + entries.size() * sizeof(PackEntry);
    for (const StoreEntry& entry : entries) {
        table.push_back({entry.key, offset, entry.value.size(), checksum_of(entry.value)});
        offset += entry.value.size();
    }
    const auto table_bytes = std::as_bytes(std::span(table));
    const PackHeader header{kPackMagic, table.size(), checksum_of(table_bytes)};
    const std::string name = hex(next_number_++) + "-" + hex(header.table_checksum) + ".pack";
    const std::string path = (fs::path(folder_) / name).string();
    std::vector<std::span<const std::byte>> parts{std::as_bytes(std::span(&header, 1)),
                                                  table_bytes};
    for (const StoreEntry& entry : entries) parts.push_back(entry.value);
    if (auto status = write_file(path, parts); !status) return status.error();
    return path;
}

Status BakeStore::put(std::span<const StoreEntry> entries) {
    if (entries.empty()) return Ok{};
    if (auto status = make_folder(); !status) return status;
    const auto path = write_pack(entries);
    if (!path) return path.error();
    const size_t sorted_count = locations_.size();
    add_pack(*path);
    sort_locations(sorted_count);
    if (!packs_.empty() && packs_.back().path == *path) {
        own_packs_.push_back(static_cast<uint32_t>(packs_.size() - 1));
    }
    return own_packs_.size() < kMaxOwnPacks ? Ok{} : merge_own_packs();
}

/// Keeps the number of packs small during long bakes, and drops replaced values.
Status BakeStore::merge_own_packs() {
    std::vector<StoreEntry> newest;
    for (const Location& location : locations_) {
        if (!std::ranges::binary_search(own_packs_, location.pack)) continue;
        if (!newest.empty() && newest.back().key == location.key) continue;
        if (checksum_of(value_at(location)) != location.checksum) continue;
        newest.push_back({location.key, value_at(location)});
    }
    const auto path = write_pack(newest);
    if (!path) return path.error();
    std::error_code error;
    for (const uint32_t pack : own_packs_) fs::remove(packs_[pack].path, error);
    packs_.clear();
    locations_.clear();
    add_packs();
    own_packs_.clear();
    for (uint32_t i = 0; i < packs_.size(); ++i) {
        if (packs_[i].path == *path) own_packs_.push_back(i);
    }
    return Ok{};
}

StoreSize BakeStore::prune(uint64_t max_bytes) {
    struct File {
        fs::file_time_type used;
        std::string path;
        uint64_t size = 0;
    };

    std::vector<File> files;
    StoreSize size;
    std::error_code error;
    for (const std::string& path : paths_of(folder_, is_pack)) {
        const uint64_t pack_size = fs::file_size(path, error);
        if (error) continue;
        files.push_back({fs::last_write_time(path, error), path, pack_size});
        size.kept += pack_size;
    }
    std::ranges::sort(files, [](const File& a, const File& b) {
        return std::tie(a.used, a.path) < std::tie(b.used, b.path);
    });
    for (const File& file : files) {
        if (size.kept <= max_bytes) break;
        fs::remove(file.path, error);
        if (error) continue;
        size.kept -= file.size;
        size.deleted += file.size;
    }
    packs_.clear();
    locations_.clear();
    own_packs_.clear();
    add_packs();
    return size;
}

}  // namespace tetralight
