// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/detail/read_ktx2.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/reflection/cube.h>

namespace tetralight::detail {
namespace {

Error corrupt(std::string_view field, const std::string& what) {
    return {ErrorCode::Corrupt, std::string(field), "", what};
}

Error unsupported(std::string_view field, const std::string& what) {
    return {ErrorCode::Unsupported, std::string(field), "", what};
}

/// The bytes at an offset; none if they are not all there.
std::optional<std::span<const std::byte>> part_of(std::span<const std::byte> bytes, uint64_t offset,
                                                  uint64_t size) {
    if (offset > bytes.size() || size > bytes.size() - offset) return std::nullopt;
    return bytes.subspan(static_cast<size_t>(offset), static_cast<size_t>(size));
}

Result<Ktx2Header> read_header(std::span<const std::byte> bytes) {
    const auto identifier = std::as_bytes(std::span(kKtx2Identifier));
    if (bytes.size() < identifier.size() ||
        !std::ranges::equal(bytes.first(identifier.size()), identifier)) {
        return corrupt("", "not a KTX 2.0 file (wrong first bytes)");
    }
    Ktx2Header header;
    if (bytes.size() < sizeof header) return corrupt("", "the file ends within its header");
    std::memcpy(&header, bytes.data(), sizeof header);
    return header;
}

Status check_kind(const Ktx2Header& header) {
    if (header.supercompression != 0) {
        return unsupported("supercompression", "the texture is compressed");
    }
    if (header.vk_format != kVkFormatRgba16Float) {
        return unsupported("vk_format", str_cat("the texture has Vulkan's format ",
                                                header.vk_format, " instead of RGBA halves (97)"));
    }
    if (header.face_count != kCubeFaceCount || header.depth != 0 || header.layer_count == 0) {
        return unsupported("face_count", "the texture is not an array of cubes");
    }
    return Ok{};
}

Status check_sizes(const Ktx2Header& header) {
    if (header.type_size != 2) {
        return corrupt("type_size", str_cat("halves of ", header.type_size, " bytes"));
    }
    if (header.width != header.height || header.width > kLargestCubeSize ||
        !std::has_single_bit(header.width)) {
        return corrupt("size",
                       str_cat("faces of ", header.width, " x ", header.height,
                               " texels: not a power of two of at most ", kLargestCubeSize));
    }
    if (header.layer_count > kMaxReflectionCubes) {
        return corrupt("layer_count",
                       str_cat(header.layer_count, " cubes are more than ", kMaxReflectionCubes));
    }
    if (header.level_count == 0 ||
        header.level_count > static_cast<uint32_t>(std::bit_width(header.width))) {
        return corrupt("level_count", str_cat(header.level_count, " levels do not fit faces of ",
                                              header.width, " texels"));
    }
    return Ok{};
}

Status check_descriptor(const Ktx2Header& header, std::span<const std::byte> bytes) {
    const auto part = part_of(bytes, header.descriptor_offset, header.descriptor_size);
    uint32_t size = 0;
    if (!part || part->size() < sizeof size) {
        return corrupt("descriptor", "the data format descriptor lies outside the file");
    }
    std::memcpy(&size, part->data(), sizeof size);
    if (size == part->size()) return Ok{};
    return corrupt("descriptor", "the data format descriptor has another size than it states");
}

/// Bytes of all probes at a level. At most 2^16 · 6 · 2^24 · 2^3.
uint64_t level_bytes(const Ktx2Header& header, uint32_t level) {
    const uint64_t size = header.width >> level;
    return header.layer_count * kCubeFaceCount * size * size * sizeof(RadianceTexel);
}

Status read_levels(std::span<const std::byte> bytes, Ktx2Cubes& cubes) {
    const uint32_t count = cubes.header.level_count;
    const auto index = part_of(bytes, sizeof(Ktx2Header), count * sizeof(Ktx2Level));
    if (!index) return corrupt("levels", "the file ends within its index of levels");
    for (uint32_t i = 0; i < count; ++i) {
        Ktx2Level level;
        std::memcpy(&level, index->data() + i * sizeof level, sizeof level);
        const std::string field = str_cat("levels[", i, "]");
        const uint64_t expected = level_bytes(cubes.header, i);
        if (level.size != expected || level.uncompressed_size != expected) {
            return corrupt(
                field, str_cat("level ", i, " has ", level.size, " bytes, ",
                               level.uncompressed_size, " uncompressed, instead of ", expected));
        }
        const auto part = part_of(bytes, level.offset, level.size);
        if (!part || level.offset % sizeof(RadianceTexel) != 0) {
            return corrupt(field, str_cat("level ", i, " lies outside the file or between texels"));
        }
        cubes.levels[i] = *part;
    }
    return Ok{};
}

struct Pair {
    std::string_view key, value;
};

/// Removes the first pair and its padding; none if it does not fit.
std::optional<Pair> take_pair(std::string_view& rest) {
    uint32_t length = 0;
    if (rest.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, rest.data(), sizeof length);
    rest.remove_prefix(sizeof length);
    if (length > rest.size()) return std::nullopt;
    const std::string_view both = rest.substr(0, length);
    const size_t key_length = both.find('\0');
    if (key_length == std::string_view::npos) return std::nullopt;
    rest.remove_prefix(std::min(rest.size(), (size_t{length} + 3) / 4 * 4));
    return Pair{both.substr(0, key_length), both.substr(key_length + 1)};
}

}  // namespace

Result<Ktx2Cubes> read_ktx2_cubes(std::span<const std::byte> bytes) {
    const auto header = read_header(bytes);
    if (!header) return header.error();
    if (auto status = check_kind(*header); !status) return status.error();
    if (auto status = check_sizes(*header); !status) return status.error();
    if (auto status = check_descriptor(*header, bytes); !status) return status.error();
    Ktx2Cubes cubes{*header, {}, {}};
    if (auto status = read_levels(bytes, cubes); !status) return status.error();
    const auto pairs = part_of(bytes, header->metadata_offset, header->metadata_size);
    if (!pairs) return corrupt("metadata", "the key/value data lies outside the file");
    cubes.pairs = {reinterpret_cast<const char*>(pairs->data()), pairs->size()};
    return cubes;
}

Status find_ktx2_values(std::string_view pairs, std::span<Ktx2Wanted> wanted) {
    while (!pairs.empty()) {
        const auto pair = take_pair(pairs);
        if (!pair) return corrupt("metadata", "a pair of the key/value data does not fit");
        const auto found = std::ranges::find(wanted, pair->key, &Ktx2Wanted::key);
        if (found == wanted.end()) continue;
        if (found->value) {
            return corrupt(pair->key, str_cat("key \"", pair->key, "\" occurs twice"));
        }
        found->value = pair->value;
    }
    return Ok{};
}

}  // namespace tetralight::detail
