// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include <tetralight/bake/image/detail/texture_3d.h>
#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/base/file.h>
#include <tetralight/base/ktx2.h>

namespace tetralight {
namespace {

constexpr uint32_t vk_format(TexelFormat format) {
    return format == TexelFormat::Rgba16Float ? kVkFormatRgba16Float : kVkFormatRgba32Float;
}

/// Key/value data, whose values are texts.
std::string encode_metadata(TextureMetadata metadata, const char* orientation) {
    metadata.emplace_back("KTXorientation", orientation);
    metadata.emplace_back("KTXwriter", "tetralight");
    std::ranges::sort(metadata);
    std::string pairs;
    for (const auto& [key, value] : metadata) {
        append_ktx2_pair(pairs, key, std::string_view(value.c_str(), value.size() + 1));
    }
    return pairs;
}

enum class Ktx2Kind : uint8_t { Volume, Array };

Ktx2Header make_header(const Texture3dView& texture, Ktx2Kind kind, size_t metadata_size) {
    Ktx2Header header;
    header.vk_format = vk_format(texture.format);
    header.type_size = detail::texel_bytes(texture.format) / 4;
    header.width = texture.width;
    header.height = texture.height;
    (kind == Ktx2Kind::Volume ? header.depth : header.layer_count) = texture.depth;
    header.descriptor_offset = sizeof(Ktx2Header) + sizeof(Ktx2Level);
    header.descriptor_size = sizeof(Ktx2Descriptor);
    header.metadata_offset = header.descriptor_offset + header.descriptor_size;
    header.metadata_size = static_cast<uint32_t>(metadata_size);
    return header;
}

/// All bytes of a file before its texels.
std::string encode_head(const Texture3dView& texture, Ktx2Kind kind,
                        const TextureMetadata& metadata) {
    const uint32_t bytes = detail::texel_bytes(texture.format);
    const Ktx2Descriptor descriptor = make_ktx2_descriptor(bytes);
    std::string pairs = encode_metadata(metadata, kind == Ktx2Kind::Volume ? "ruo" : "rd");
    const Ktx2Header header = make_header(texture, kind, pairs.size());

    Ktx2Level level;
    const size_t end = header.metadata_offset + pairs.size();
    level.offset = (end + bytes - 1) / bytes * bytes;  // texels are aligned
    level.size = level.uncompressed_size = texture.texels.size();
    pairs.resize(pairs.size() + (level.offset - end));
    std::string head(reinterpret_cast<const char*>(&header), sizeof header);
    head.append(reinterpret_cast<const char*>(&level), sizeof level);
    head.append(reinterpret_cast<const char*>(&descriptor), sizeof descriptor);
    return head + pairs;
}

Status write_ktx2_file(const std::string& path, const Texture3dView& texture, Ktx2Kind kind,
                       const TextureMetadata& metadata) {
    if (auto status = detail::check_texture(path, texture); !status) return status;
    const std::string head = encode_head(texture, kind, metadata);
    const std::array parts{std::as_bytes(std::span(head)), texture.texels};
    return write_file(path, parts);
}

}  // namespace

std::string encode_ktx2(const Texture3dView& texture, const TextureMetadata& metadata) {
    std::string file = encode_head(texture, Ktx2Kind::Volume, metadata);
    return file.append(reinterpret_cast<const char*>(texture.texels.data()), texture.texels.size());
}

Status write_ktx2(const std::string& path, const Texture3dView& texture,
                  const TextureMetadata& metadata) {
    return write_ktx2_file(path, texture, Ktx2Kind::Volume, metadata);
}

Status write_ktx2_array(const std::string& path, const Texture3dView& layers,
                        const TextureMetadata& metadata) {
    return write_ktx2_file(path, layers, Ktx2Kind::Array, metadata);
}

}  // namespace tetralight
