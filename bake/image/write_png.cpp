// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/file.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace tetralight {
namespace {

void append_bytes(void* target, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(target);
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

/// The checksum of PNG chunks: CRC-32 of ISO 3309, as the PNG specification has it in annex D.
uint32_t chunk_checksum(std::span<const std::byte> bytes) {
    uint32_t checksum = 0xffffffffu;
    for (const std::byte byte : bytes) {
        checksum ^= std::to_integer<uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            checksum = checksum >> 1 ^ ((checksum & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~checksum;
}

void append_big_endian(std::vector<std::byte>& bytes, uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::byte>(value >> shift));
}

std::vector<std::byte> text_chunk(const std::string& keyword, const std::string& text) {
    const std::string content = "tEXt" + keyword + '\0' + text;
    const auto bytes = std::as_bytes(std::span(content));
    std::vector<std::byte> chunk;
    append_big_endian(chunk, static_cast<uint32_t>(content.size() - 4));
    chunk.insert(chunk.end(), bytes.begin(), bytes.end());
    append_big_endian(chunk, chunk_checksum(bytes));
    return chunk;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image8& image, const PngTexts& texts) {
    TETRALIGHT_ASSERT(image.pixels.size() == uint64_t{image.width} * image.height,
                      "an image has width * height pixels");
    if (auto status = detail::check_writable_size("image", image.width, image.height); !status) {
        return status.error();
    }
    std::vector<std::byte> bytes;
    const int width = static_cast<int>(image.width);
    if (stbi_write_png_to_func(append_bytes, &bytes, width, static_cast<int>(image.height), 4,
                               image.pixels.data(), width * 4) == 0) {
        return Error{ErrorCode::OutOfResources, "cannot encode PNG image"};
    }
    constexpr size_t kHeaderEnd = 33;  // signature and IHDR
    size_t end = kHeaderEnd;
    for (const auto& [keyword, text] : texts) {
        const std::vector<std::byte> chunk = text_chunk(keyword, text);
        bytes.insert(bytes.begin() + static_cast<ptrdiff_t>(end), chunk.begin(), chunk.end());
        end += chunk.size();
    }
    return bytes;
}

Status write_png(const std::string& path, const Image8& image) {
    if (auto status = detail::check_writable_size(path, image.width, image.height); !status) {
        return status;
    }
    const auto bytes = encode_png(image);
    if (!bytes) return bytes.error().in(path);
    return write_file(path, *bytes);
}

}  // namespace tetralight
