// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>

#include <tetralight/bake/image/detail/texture_3d.h>
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/base/file.h>

// The layout: Khronos, "KTX File Format Specification, version 2.0" and "Data Format Specification,
// version 1.3", section 5 (basic descriptor block).

namespace tetralight {
namespace {

constexpr std::array<uint8_t, 12> kIdentifier{0xAB, 'K',  'T',  'X',  ' ',  '2',
                                              '0',  0xBB, '\r', '\n', 0x1A, '\n'};

struct Ktx2Header {
    std::array<uint8_t, 12> identifier = kIdentifier;
    uint32_t vk_format = 0;
    uint32_t type_size = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t depth = 0;
    uint32_t layer_count = 0;
    uint32_t face_count = 1;
    uint32_t level_count = 1;
    uint32_t supercompression = 0;
    uint32_t descriptor_offset = 0;
    uint32_t descriptor_size = 0;
    uint32_t metadata_offset = 0;
    uint32_t metadata_size = 0;
    // 64-bit in the file; zero, and the header is written as it stands in memory.
    std::array<uint32_t, 4> global_data{};
};

static_assert(sizeof(Ktx2Header) == 80);

struct Level {
    uint64_t offset = 0;
    uint64_t size = 0;
    uint64_t uncompressed_size = 0;
};

struct Sample {
    uint16_t bit_offset = 0;
    uint8_t bit_length = 0;  ///< less one
    uint8_t channel = 0;
    std::array<uint8_t, 4> position{};
    float lower = -1.0f;
    float upper = 1.0f;
};

/// The data format descriptor of four floats: linear, primaries of Rec.709.
struct Descriptor {
    uint32_t total_size = 92;
    uint32_t vendor_and_type = 0;
    uint16_t version = 2;
    uint16_t block_size = 88;
    uint8_t color_model = 1;  ///< KHR_DF_MODEL_RGBSDA
    uint8_t primaries = 1;    ///< KHR_DF_PRIMARIES_BT709
    uint8_t transfer = 1;     ///< KHR_DF_TRANSFER_LINEAR
    uint8_t flags = 0;        ///< alpha is straight
    std::array<uint8_t, 4> texel_block{};
    std::array<uint8_t, 8> plane_bytes{};
    std::array<Sample, 4> samples{};
};

static_assert(sizeof(Descriptor) == 92);

constexpr uint32_t vk_format(TexelFormat format) {
    return format == TexelFormat::Rgba16Float ? 97 : 109;  // R16G16B16A16_SFLOAT, R32G32B32A32
}

Descriptor make_descriptor(TexelFormat format) {
    constexpr uint8_t kFloatAndSigned = 0x80 | 0x40;
    constexpr std::array<uint8_t, 4> kChannels{0, 1, 2, 15};  // red, green, blue, alpha
    Descriptor descriptor;
    const uint32_t bytes = detail::texel_bytes(format);
    descriptor.plane_bytes[0] = static_cast<uint8_t>(bytes);
    for (size_t i = 0; i < 4; ++i) {
        const uint32_t bits = 2 * bytes;
        descriptor.samples[i].bit_offset = static_cast<uint16_t>(i * bits);
        descriptor.samples[i].bit_length = static_cast<uint8_t>(bits - 1);
        descriptor.samples[i].channel = static_cast<uint8_t>(kChannels[i] | kFloatAndSigned);
    }
    return descriptor;
}

/// Each entry: its length, key, zero, text, zero, and zeros up to a multiple of four. Sorted by
/// key.
std::string encode_metadata(TextureMetadata metadata, const char* orientation) {
    metadata.emplace_back("KTXorientation", orientation);
    metadata.emplace_back("KTXwriter", "tetralight");
    std::ranges::sort(metadata);
    std::string bytes;
    for (const auto& [key, value] : metadata) {
        const auto length = static_cast<uint32_t>(key.size() + value.size() + 2);
        bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
        bytes.append(key).push_back('\0');
        bytes.append(value).push_back('\0');
        bytes.resize((bytes.size() + 3) / 4 * 4);
    }
    return bytes;
}

enum class Ktx2Kind : uint8_t { Volume, Array };

Ktx2Header make_header(const Texture3dView& texture, Ktx2Kind kind, size_t metadata_size) {
    Ktx2Header header;
    header.vk_format = vk_format(texture.format);
    header.type_size = detail::texel_bytes(texture.format) / 4;
    header.width = texture.width;
    header.height = texture.height;
    (kind == Ktx2Kind::Volume ? header.depth : header.layer_count) = texture.depth;
    header.descriptor_offset = sizeof(Ktx2Header) + sizeof(Level);
    header.descriptor_size = sizeof(Descriptor);
    header.metadata_offset = header.descriptor_offset + header.descriptor_size;
    header.metadata_size = static_cast<uint32_t>(metadata_size);
    return header;
}

Status write_ktx2_file(const std::string& path, const Texture3dView& texture, Ktx2Kind kind,
                       const TextureMetadata& metadata) {
    if (auto status = detail::check_texture(path, texture); !status) return status;
    const uint32_t bytes = detail::texel_bytes(texture.format);
    const Descriptor descriptor = make_descriptor(texture.format);
    std::string pairs = encode_metadata(metadata, kind == Ktx2Kind::Volume ? "ruo" : "rd");
    const Ktx2Header header = make_header(texture, kind, pairs.size());

    Level level;
    const size_t end = header.metadata_offset + pairs.size();
    level.offset = (end + bytes - 1) / bytes * bytes;  // texels are aligned
    level.size = level.uncompressed_size = texture.texels.size();
    pairs.resize(pairs.size() + (level.offset - end));
    const std::array parts{
        std::as_bytes(std::span(&header, 1)), std::as_bytes(std::span(&level, 1)),
        std::as_bytes(std::span(&descriptor, 1)), std::as_bytes(std::span(pairs)), texture.texels};
    return write_file(path, parts);
}

}  // namespace

Status write_ktx2(const std::string& path, const Texture3dView& texture,
                  const TextureMetadata& metadata) {
    return write_ktx2_file(path, texture, Ktx2Kind::Volume, metadata);
}

Status write_ktx2_array(const std::string& path, const Texture3dView& layers,
                        const TextureMetadata& metadata) {
    return write_ktx2_file(path, layers, Ktx2Kind::Array, metadata);
}

}  // namespace tetralight
