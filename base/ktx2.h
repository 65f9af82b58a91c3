// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

// The parts of KTX 2.0 files, little-endian as in the file. Khronos, "KTX File Format
// Specification, version 2.0" and "Data Format Specification, version 1.3", section 5 (basic
// descriptor block).

namespace tetralight {

inline constexpr std::array<uint8_t, 12> kKtx2Identifier{0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                         '0',  0xBB, '\r', '\n', 0x1A, '\n'};

/// Of Vulkan.
inline constexpr uint32_t kVkFormatRgba16Float = 97, kVkFormatRgba32Float = 109;

/// The first bytes of a file; a `Ktx2Level` for each level follows.
struct Ktx2Header {
    std::array<uint8_t, 12> identifier = kKtx2Identifier;
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

static_assert(sizeof(Ktx2Header) == 80 && std::is_trivially_copyable_v<Ktx2Header>);

/// Where the texels of a level lie in the file.
struct Ktx2Level {
    uint64_t offset = 0;
    uint64_t size = 0;
    uint64_t uncompressed_size = 0;
};

static_assert(sizeof(Ktx2Level) == 24 && std::is_trivially_copyable_v<Ktx2Level>);

/// One channel of a texel.
struct Ktx2Sample {
    uint16_t bit_offset = 0;
    uint8_t bit_length = 0;  ///< less one
    uint8_t channel = 0;
    std::array<uint8_t, 4> position{};
    float lower = -1.0f;
    float upper = 1.0f;
};

/// The data format descriptor of four floats: linear, primaries of Rec.709.
struct Ktx2Descriptor {
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
    std::array<Ktx2Sample, 4> samples{};
};

static_assert(sizeof(Ktx2Descriptor) == 92 && std::is_trivially_copyable_v<Ktx2Descriptor>);

/// Of RGBA floats of 8 or 16 bytes a texel.
[[nodiscard]] constexpr Ktx2Descriptor make_ktx2_descriptor(uint32_t texel_bytes) noexcept {
    constexpr uint8_t kFloatAndSigned = 0x80 | 0x40;
    constexpr std::array<uint8_t, 4> kChannels{0, 1, 2, 15};  // red, green, blue, alpha
    Ktx2Descriptor descriptor;
    descriptor.plane_bytes[0] = static_cast<uint8_t>(texel_bytes);
    const uint32_t bits = 2 * texel_bytes;
    for (uint32_t i = 0; i < 4; ++i) {
        descriptor.samples[i].bit_offset = static_cast<uint16_t>(i * bits);
        descriptor.samples[i].bit_length = static_cast<uint8_t>(bits - 1);
        descriptor.samples[i].channel = static_cast<uint8_t>(kChannels[i] | kFloatAndSigned);
    }
    return descriptor;
}

/// Appends a pair of the key/value data: its length, key, zero, value, and zeros up to a multiple
/// of four. Texts end with a zero; `value` contains it. Pairs must be sorted by key.
inline void append_ktx2_pair(std::string& pairs, std::string_view key, std::string_view value) {
    const auto length = static_cast<uint32_t>(key.size() + 1 + value.size());
    pairs.append(reinterpret_cast<const char*>(&length), sizeof length);
    pairs.append(key).push_back('\0');
    pairs.append(value);
    pairs.resize((pairs.size() + 3) / 4 * 4);
}

}  // namespace tetralight
