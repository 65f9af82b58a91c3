// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/content_hash.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight {

void ContentHash::add_bytes(std::span<const std::byte> bytes) noexcept {
    value_ = XXH3_64bits_withSeed(bytes.data(), bytes.size(), value_);
}

}  // namespace tetralight
