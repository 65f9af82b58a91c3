// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Image files written byte by byte, without the libraries that read them.

namespace tetralight::test {

inline std::string big_endian(uint32_t value, int byte_count) {
    std::string bytes;
    for (int i = byte_count - 1; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
}

inline std::string little_endian(uint32_t value, int byte_count) {
    std::string bytes;
    for (int i = 0; i < byte_count; ++i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
}

/// The CRC-32 of ISO 3309, as the PNG specification has it in annex D.
inline uint32_t crc32(std::string_view bytes) {
    uint32_t checksum = 0xffffffffu;
    for (const char byte : bytes) {
        checksum ^= static_cast<uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            checksum = checksum >> 1 ^ ((checksum & 1u) != 0 ? 0xedb88320u : 0u);
        }
    }
    return ~checksum;
}

/// A zlib stream (RFC 1950) of one block that is stored, not compressed. Precondition: fewer than
/// 65536 bytes.
inline std::string stored_zlib(std::string_view bytes) {
    uint32_t a = 1, b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<uint32_t>(bytes.size());
    return std::string("\x78\x01\x01") + little_endian(size, 2) + little_endian(~size, 2) +
           std::string(bytes) + big_endian(b << 16 | a, 4);
}

inline std::string png_chunk(std::string_view type, std::string_view content) {
    const std::string named = std::string(type) + std::string(content);
    return big_endian(static_cast<uint32_t>(content.size()), 4) + named +
           big_endian(crc32(named), 4);
}

struct PngHeader {
    uint32_t width = 1;
    uint32_t height = 1;
    uint8_t bit_depth = 8;
    uint8_t color_type = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    uint8_t interlace = 0;
};

/// A PNG. `lines` are its scan lines, each after the byte of its filter; `chunks` stand before
/// them.
inline std::string png_file(const PngHeader& header, std::string_view lines,
                            std::string_view chunks = {}) {
    const char rest[] = {static_cast<char>(header.bit_depth), static_cast<char>(header.color_type),
                         0, 0, static_cast<char>(header.interlace)};
    return "\x89PNG\r\n\x1a\n" +
           png_chunk("IHDR", big_endian(header.width, 4) + big_endian(header.height, 4) +
                                 std::string(rest, sizeof rest)) +
           std::string(chunks) + png_chunk("IDAT", stored_zlib(lines)) + png_chunk("IEND", "");
}

/// Bits of the entropy-coded data of a JPEG, first bit first.
class JpegBits {
  public:
    void add(uint32_t value, int bit_count) {
        for (int i = bit_count - 1; i >= 0; --i) bits_.push_back((value >> i & 1u) != 0);
    }

    /// The bytes, filled up with ones; a zero follows each byte of ones.
    [[nodiscard]] std::string bytes() const {
        std::string bytes;
        for (size_t i = 0; i < bits_.size(); i += 8) {
            uint32_t byte = 0;
            for (size_t k = i; k < i + 8; ++k) byte = byte << 1 | (k >= bits_.size() || bits_[k]);
            bytes += static_cast<char>(byte);
            if (byte == 255) bytes += '\0';
        }
        return bytes;
    }

  private:
    std::vector<bool> bits_;
};

struct JpegOptions {
    bool is_progressive = false;
    /// Blocks of the first channel side by side and one upon another, for one of each other: 1
    /// or 2.
    uint8_t sampling = 1;
    std::string ids = "\1\2\3\4";  ///< of the channels
    std::string markers = {};      ///< after the first one
};

inline std::string jpeg_segment(uint8_t marker, const std::string& content) {
    return std::string(1, '\xff') + static_cast<char>(marker) +
           big_endian(static_cast<uint32_t>(content.size() + 2), 2) + content;
}

/// Adobe's marker. 0: RGB or CMYK; 1: YCbCr; 2: YCCK.
inline std::string adobe_segment(uint8_t transform) {
    return jpeg_segment(0xee,
                        std::string("Adobe\0\x64\0\0\0\0", 11) + static_cast<char>(transform));
}

/// Huffman tables for `add_level`: codes of 4 bits for the sizes 0 to 11 of differences, and the
/// code 0 for the end of a block.
inline std::string jpeg_tables() {
    const std::string dc_counts("\0\0\0\x0c\0\0\0\0\0\0\0\0\0\0\0\0", 16);
    const std::string dc_sizes("\0\1\2\3\4\5\6\7\x08\x09\x0a\x0b", 12);
    const std::string ac("\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);
    return jpeg_segment(0xc4, std::string(1, '\0') + dc_counts + dc_sizes) + jpeg_segment(0xc4, ac);
}

/// Adds a difference of mean levels: its size in 4 bits, then that many bits of it.
inline void add_level(JpegBits& bits, int difference) {
    uint32_t size = 0;
    while (difference >= 1 << size || -difference >= 1 << size) ++size;
    bits.add(size, 4);
    const int coded = difference < 0 ? difference + (1 << size) - 1 : difference;
    bits.add(static_cast<uint32_t>(coded), static_cast<int>(size));
}

/// A JPEG of one colour, one group of blocks large: 8 or 16 pixels wide and high. A channel of
/// value v has the mean coefficient 8 · (v − 128) at quantization 1, so that its samples are exact.
inline std::string constant_jpeg(const std::vector<uint8_t>& channels,
                                 const JpegOptions& options = {}) {
    const auto count = static_cast<char>(channels.size());
    const uint32_t size = 8u * options.sampling;
    std::string frame = "\x08" + big_endian(size, 2) + big_endian(size, 2) + count;
    std::string scan(1, count);
    JpegBits bits;
    for (size_t c = 0; c < channels.size(); ++c) {
        const int side = c == 0 ? options.sampling : 1;
        frame += options.ids[c];
        frame += static_cast<char>(side << 4 | side);
        frame += '\0';
        scan += std::string{options.ids[c], '\0'};
        for (int block = 0; block < side * side; ++block) {
            add_level(bits, block == 0 ? 8 * (channels[c] - 128) : 0);
            if (!options.is_progressive) bits.add(0, 1);  // the end of the block
        }
    }
    scan += options.is_progressive ? std::string("\0\0\0", 3) : std::string("\0\x3f\0", 3);
    return "\xff\xd8" + options.markers + jpeg_segment(0xdb, '\0' + std::string(64, '\1')) +
           jpeg_segment(options.is_progressive ? 0xc2 : 0xc0, frame) + jpeg_tables() +
           jpeg_segment(0xda, scan) + bits.bytes() + "\xff\xd9";
}

/// A Radiance file. A flat pixel is (mantissa, mantissa, mantissa, exponent):
/// value = mantissa / 256 · 2^(exponent − 128).
inline std::string radiance_file(std::string_view size, std::string_view pixels,
                                 std::string_view variables = "FORMAT=32-bit_rle_rgbe\n") {
    return "#?RADIANCE\n" + std::string(variables) + "\n" + std::string(size) + "\n" +
           std::string(pixels);
}

}  // namespace tetralight::test
