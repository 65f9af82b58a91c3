// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/file_ids.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <tetralight/base/descriptor_io.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/system_error.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight::server {
namespace {

constexpr size_t kPiece = size_t{1} << 20;

Result<Descriptor> open_regular(const std::string& path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file) return system_error(path, "open");
    struct stat status = {};
    if (::fstat(file.value(), &status) != 0) return system_error(path, "read");
    if (S_ISREG(status.st_mode)) return file;
    return Error{ErrorCode::InvalidArgument, path + ": is not a regular file"};
}

/// Fills `memory` as far as the file goes.
Result<std::span<const std::byte>> read_piece(const Descriptor& file, const std::string& path,
                                              std::span<std::byte> memory) {
    const auto count = read_up_to(file, memory);
    if (!count) return system_error(path, "read");
    return std::span<const std::byte>(memory.first(*count));
}

struct FreeXxh {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

Result<FileIds> read_file_ids(const std::string& path) {
    const auto file = open_regular(path);
    if (!file) return file.error();
    Sha256 sha;
    const std::unique_ptr<XXH3_state_t, FreeXxh> xxh(XXH3_createState());
    XXH3_128bits_reset(xxh.get());
    FileIds ids;
    std::vector<std::byte> memory(kPiece);
    while (true) {
        const auto piece = read_piece(*file, path, memory);
        if (!piece) return piece.error();
        if (piece->empty()) break;
        sha.add(*piece);
        XXH3_128bits_update(xxh.get(), piece->data(), piece->size());
        ids.bytes += piece->size();
    }
    const XXH128_hash_t old = XXH3_128bits_digest(xxh.get());
    ids.id = sha.hex();
    ids.old_id = hex(old.high64) + hex(old.low64);
    return ids;
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
