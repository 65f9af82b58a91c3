// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/glb_container.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using Bytes = std::span<const std::byte>;

constexpr size_t kGlbHeaderSize = 12;
constexpr size_t kChunkHeaderSize = 8;
constexpr uint32_t kGlbVersion = 2;
constexpr uint32_t kGlbMagicWord = 0x46546c67;
constexpr uint32_t kJsonChunk = 0x4e4f534a;
constexpr uint32_t kBinaryChunkType = 0x004e4942;

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

void append_words(std::vector<std::byte>& out, std::initializer_list<size_t> words) {
    for (const size_t word : words) {
        const auto bits = static_cast<uint32_t>(word);
        const auto bytes = std::as_bytes(std::span(&bits, 1));
        out.insert(out.end(), bytes.begin(), bytes.end());
    }
}

void append_chunk(std::vector<std::byte>& out, uint32_t type, Bytes bytes, char padding) {
    const size_t size = (bytes.size() + 3) / 4 * 4;
    append_words(out, {size, type});
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.resize(out.size() + (size - bytes.size()), static_cast<std::byte>(padding));
}

}  // namespace

bool is_glb(Bytes bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

Result<GlbChunks> glb_chunks(Bytes bytes) {
    if (bytes.size() < kGlbHeaderSize)
        return Error{ErrorCode::Corrupt, "is cut off in the GLB header"};
    const uint32_t version = read_u32(bytes, 4);
    if (version != kGlbVersion) {
        return Error{
            ErrorCode::Unsupported, "version", str_cat(version),
            str_cat(
                "GLB version ", version, " is not supported (2 is)",
                version == 1 ? "; `gltf-pipeline -i IN.glb -o OUT.glb` makes it glTF 2.0" : "")};
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
    GlbChunks chunks;
    size_t index = 0;
    for (size_t offset = kGlbHeaderSize; offset < bytes.size(); ++index) {
        const auto size = chunk_length(bytes, offset);
        if (!size) return size.error();
        const Bytes data = bytes.subspan(offset + kChunkHeaderSize, *size);
        if (index == 0) chunks.json = data;
        if (index == 1 && read_u32(bytes, offset + 4) == kBinaryChunkType) chunks.binary = data;
        offset += kChunkHeaderSize + *size;
    }
    return chunks;
}

Result<std::vector<std::byte>> make_glb(std::string json, Bytes binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const size_t padded = (binary.size() + 3) / 4 * 4;
    const size_t size = kGlbHeaderSize + kChunkHeaderSize + json.size() +
                        (binary.empty() ? 0 : kChunkHeaderSize + padded);
    if (size > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::Unsupported, str_cat(size, " bytes are too many for a .glb file")};
    }
    std::vector<std::byte> out;
    out.reserve(size);
    append_words(out, {kGlbMagicWord, kGlbVersion, size});
    append_chunk(out, kJsonChunk, std::as_bytes(std::span(json)), ' ');
    if (!binary.empty()) append_chunk(out, kBinaryChunkType, binary, '\0');
    return out;
}

}  // namespace tetralight
