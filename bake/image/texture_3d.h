// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

enum class TexelFormat : uint8_t {
    Rgba16Float,
    Rgba32Float,
};

/// A 3D texture with one mip level. x varies fastest, then y, then z.
struct Texture3dView {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t depth = 0;
    TexelFormat format = TexelFormat::Rgba16Float;
    /// Precondition: width · height · depth texels, little-endian.
    std::span<const std::byte> texels;
};

/// Writes a DDS file with a DX10 header; the old file stays whole on failure.
[[nodiscard]] Status write_dds(const std::string& path, const Texture3dView& texture);

/// Pairs of a key and a text.
using TextureMetadata = std::vector<std::pair<std::string, std::string>>;

/// Writes a KTX 2.0 file, not compressed, whose x, y and z point right, up and out; the old file
/// stays whole on failure. Precondition: keys are UTF-8 without zeros and do not begin with "KTX"
/// or "ktx".
[[nodiscard]] Status write_ktx2(const std::string& path, const Texture3dView& texture,
                                const TextureMetadata& metadata);

/// The bytes of the same file. Precondition: the texture has texels.
[[nodiscard]] std::string encode_ktx2(const Texture3dView& texture,
                                      const TextureMetadata& metadata);

/// Writes a KTX 2.0 file of a 2D array texture, whose layers are the slices of `layers`. x and y
/// point right and down. Otherwise as `write_ktx2`.
[[nodiscard]] Status write_ktx2_array(const std::string& path, const Texture3dView& layers,
                                      const TextureMetadata& metadata);

}  // namespace tetralight
