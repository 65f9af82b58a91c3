// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/glb_container.h>

#include <cstdint>
#include <cstring>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

constexpr size_t kGlbHeaderSize = 12;
constexpr size_t kChunkHeaderSize = 8;
constexpr uint32_t kGlbVersion = 2;
constexpr uint32_t kJsonChunk = 0x4e4f534a;

uint32_t read_u32(Bytes bytes, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// Length of the data of the chunk whose header is at `offset`.
Result<size_t> chunk_length(Bytes bytes, size_t offset) {
    if (bytes.size() - offset < kChunkHeaderSize) {
        return Error{ErrorCode::Corrupt,
                     str_cat("is cut off in the chunk header at byte ", offset)};
    }
    const size_t length = read_u32(bytes, offset);
    const size_t left = bytes.size() - offset - kChunkHeaderSize;
    if (length <= left) return length;
    return Error{ErrorCode::Corrupt, str_cat("is cut off: the chunk at byte ", offset, " has ",
                                             length, " bytes, ", left, " are left")};
}

}  // namespace

bool is_glb(Bytes bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

Result<Bytes> glb_json(Bytes bytes) {
    if (bytes.size() < kGlbHeaderSize)
        return Error{ErrorCode::Corrupt, "is cut off in the GLB header"};
    const uint32_t version = read_u32(bytes, 4);
    if (version != kGlbVersion) {
        return Error{ErrorCode::Unsupported, "version", str_cat(version),
                     str_cat("GLB version ", version, " is not supported")};
    }
    const size_t length = read_u32(bytes, 8);
    if (length != bytes.size()) {
        return Error{ErrorCode::Corrupt, "length", str_cat(length),
                     str_cat("has ", bytes.size(), " bytes, its header says ", length)};
    }
    const auto json_length = chunk_length(bytes, kGlbHeaderSize);
    if (!json_length) return json_length.error();
    if (read_u32(bytes, kGlbHeaderSize + 4) != kJsonChunk) {
        return Error{ErrorCode::Corrupt, "first chunk is not JSON"};
    }
    for (size_t offset = kGlbHeaderSize; offset < bytes.size();) {
        const auto size = chunk_length(bytes, offset);
        if (!size) return size.error();
        offset += kChunkHeaderSize + *size;
    }
    return bytes.subspan(kGlbHeaderSize + kChunkHeaderSize, *json_length);
}

}  // namespace tetralight::detail
