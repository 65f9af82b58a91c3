// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/file_ids.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/system_error.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight::server {
namespace {

constexpr size_t kPiece = size_t{1} << 20;

/// Fills `memory` as far as the file goes.
Result<std::span<const std::byte>> read_piece(const Descriptor& file, const std::string& path,
                                              std::span<std::byte> memory) {
    const auto count = read_up_to(file, memory);
    if (!count) return system_error(path, "read");
    return std::span<const std::byte>(memory.first(*count));
}

}  // namespace

struct FileIdsHash::State {
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };

    Sha256 sha;
    std::unique_ptr<XXH3_state_t, Free> xxh{XXH3_createState()};
    uint64_t bytes = 0;
};

FileIdsHash::FileIdsHash() : state_(std::make_unique<State>()) {
    XXH3_128bits_reset(state_->xxh.get());
}

FileIdsHash::FileIdsHash(FileIdsHash&&) noexcept = default;
FileIdsHash::~FileIdsHash() = default;

void FileIdsHash::add(std::span<const std::byte> bytes) {
    state_->sha.add(bytes);
    XXH3_128bits_update(state_->xxh.get(), bytes.data(), bytes.size());
    state_->bytes += bytes.size();
}

FileIds FileIdsHash::ids() const {
    const XXH128_hash_t old = XXH3_128bits_digest(state_->xxh.get());
    return {state_->sha.hex(), hex(old.high64) + hex(old.low64), state_->bytes};
}

Result<Descriptor> open_regular(const std::string& path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file) return system_error(path, "open");
    struct stat status = {};
    if (::fstat(file.value(), &status) != 0) return system_error(path, "read");
    if (S_ISREG(status.st_mode)) return file;
    return Error{ErrorCode::InvalidArgument, shown_path(path) + ": is not a regular file"};
}

Result<FileIds> read_file_ids(const std::string& path) {
    const auto file = open_regular(path);
    if (!file) return file.error();
    FileIdsHash hash;
    std::vector<std::byte> memory(kPiece);
    while (true) {
        const auto piece = read_piece(*file, path, memory);
        if (!piece) return piece.error();
        if (piece->empty()) return hash.ids();
        hash.add(*piece);
    }
}

Status copy_file(const std::string& path, const Descriptor& to) {
    const auto file = open_regular(path);
    if (!file) return file.error();
    std::vector<std::byte> memory(kPiece);
    while (true) {
        auto piece = read_piece(*file, path, memory);
        if (!piece) return piece.error();
        if (piece->empty()) return Ok{};
        if (!write_all(to, *piece)) return system_error("copy " + path);
    }
}

Result<bool> have_same_bytes(const std::string& a, const std::string& b) {
    const auto first = open_regular(a);
    if (!first) return first.error();
    const auto second = open_regular(b);
    if (!second) return second.error();
    std::vector<std::byte> memory_a(kPiece), memory_b(kPiece);
    while (true) {
        const auto piece_a = read_piece(*first, a, memory_a);
        if (!piece_a) return piece_a.error();
        const auto piece_b = read_piece(*second, b, memory_b);
        if (!piece_b) return piece_b.error();
        if (!std::ranges::equal(*piece_a, *piece_b)) return false;
        if (piece_a->empty()) return true;
    }
}

}  // namespace tetralight::server
