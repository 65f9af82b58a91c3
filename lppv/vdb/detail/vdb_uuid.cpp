// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/vdb/detail/vdb_uuid.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <tetralight/base/hex.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight::detail {
namespace {

// The header of io/Archive.h: magic number (8 bytes), file version (4), library version (2 × 4),
// flag for grid offsets (1), UUID as text (36).
constexpr size_t kMagicSize = 8;
constexpr size_t kUuidOffset = 21;
constexpr size_t kUuidSize = 36;
constexpr char kMagic[kMagicSize + 1] = " BDV\0\0\0\0";

bool is_dash(size_t i) {
    return i == 8 || i == 13 || i == 18 || i == 23;
}

bool is_vdb(std::span<const char> file) {
    if (file.size() < kUuidOffset + kUuidSize) return false;
    if (std::memcmp(file.data(), kMagic, kMagicSize) != 0) return false;
    for (size_t i = 0; i < kUuidSize; ++i) {
        if ((file[kUuidOffset + i] == '-') != is_dash(i)) return false;
    }
    return true;
}

}  // namespace

void set_vdb_uuid(std::span<char> file) {
    if (!is_vdb(file)) return;
    const std::span<char> uuid = file.subspan(kUuidOffset, kUuidSize);
    std::ranges::fill(uuid, '0');
    ContentHash hash;
    hash.add_bytes(std::as_bytes(file));
    uint64_t digits = hash.value();
    for (size_t i = 0; i < kUuidSize; ++i) {
        if (is_dash(i)) {
            uuid[i] = '-';
        } else if (digits != 0) {
            uuid[i] = kHexDigits[digits & 15];
            digits >>= 4;
        }
    }
}

}  // namespace tetralight::detail
