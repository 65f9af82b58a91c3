// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <tetralight/bake/image/detail/texture_3d.h>
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/file.h>

// The layout: Microsoft, "Programming guide for DDS", DDS_HEADER and DDS_HEADER_DXT10.

namespace tetralight {
namespace {

constexpr uint32_t four_characters(const char (&name)[5]) {
    return static_cast<uint32_t>(name[0]) | static_cast<uint32_t>(name[1]) << 8 |
           static_cast<uint32_t>(name[2]) << 16 | static_cast<uint32_t>(name[3]) << 24;
}

// DDSD_CAPS, HEIGHT, WIDTH, PITCH, PIXELFORMAT, DEPTH
constexpr uint32_t kFlags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000 | 0x800000;
constexpr uint32_t kPixelFormatFourCc = 0x4;
constexpr uint32_t kCaps = 0x8 | 0x1000;  // DDSCAPS_COMPLEX, TEXTURE
constexpr uint32_t kCaps2Volume = 0x200000;
constexpr uint32_t kDimensionTexture3d = 4;

struct DdsHeader {
    uint32_t magic = four_characters("DDS ");
    uint32_t size = 124;
    uint32_t flags = kFlags;
    uint32_t height = 0;
    uint32_t width = 0;
    uint32_t pitch = 0;
    uint32_t depth = 0;
    uint32_t mip_count = 1;
    std::array<uint32_t, 11> reserved{};
    uint32_t pixel_format_size = 32;
    uint32_t pixel_format_flags = kPixelFormatFourCc;
    uint32_t pixel_format = four_characters("DX10");
    std::array<uint32_t, 5> masks{};
    uint32_t caps = kCaps;
    uint32_t caps2 = kCaps2Volume;
    std::array<uint32_t, 3> reserved2{};
    uint32_t dxgi_format = 0;
    uint32_t dimension = kDimensionTexture3d;
    uint32_t misc_flags = 0;
    uint32_t array_size = 1;
    uint32_t misc_flags2 = 0;
};

static_assert(sizeof(DdsHeader) == 4 + 124 + 20);

constexpr uint32_t dxgi_format(TexelFormat format) {
    return format == TexelFormat::Rgba16Float ? 10 : 2;  // R16G16B16A16_FLOAT, R32G32B32A32_FLOAT
}

}  // namespace

Status write_dds(const std::string& path, const Texture3dView& texture) {
    if (auto status = detail::check_texture(path, texture); !status) return status;
    DdsHeader header;
    header.width = texture.width;
    header.height = texture.height;
    header.depth = texture.depth;
    header.pitch = texture.width * detail::texel_bytes(texture.format);
    header.dxgi_format = dxgi_format(texture.format);
    const std::array parts{std::as_bytes(std::span(&header, 1)), texture.texels};
    return write_file(path, parts);
}

}  // namespace tetralight
