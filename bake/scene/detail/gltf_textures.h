// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The first image of the document with the same bytes by reference: the same buffer view, file or
/// data URI.
[[nodiscard]] uint32_t first_image_alike(const GltfDocument& document, uint32_t image);

/// Decodes an image. Returns the errors of reading its file and of decoding; their field is that of
/// the image.
[[nodiscard]] Result<Image8> decode_gltf_image(const GltfDocument& document, uint32_t image);

/// Decodes the textures that materials use: images that share their bytes once for each pair of
/// wrap modes.
class GltfTextureReader {
  public:
    explicit GltfTextureReader(const GltfDocument& document) : document_(document) {}

    /// Index in `textures` of a glTF texture. Returns kNoIndex and adds a warning if only an
    /// extension that is not known names its image, and unsupported if it has no image but one of
    /// KHR_texture_basisu.
    [[nodiscard]] Result<uint32_t> read(uint32_t gltf_texture);

    std::vector<Texture> textures;
    std::vector<std::string> warnings;

  private:
    [[nodiscard]] Result<uint32_t> find_or_decode(const GltfTexture& source);

    const GltfDocument& document_;
    /// By image index and the two wrap modes.
    std::map<std::array<uint32_t, 3>, uint32_t> known_;
};

}  // namespace tetralight::detail
