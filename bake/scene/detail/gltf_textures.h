// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_images.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Decodes the textures that materials use: images that share their bytes once for each pair of
/// wrap modes.
class GltfTextureReader {
  public:
    GltfTextureReader(const GltfDocument& document, GltfImages& images)
        : document_(document), images_(images) {}

    /// Index in `textures` of a glTF texture. Returns kNoIndex and adds to `parts` if only an
    /// extension that is not known names its image, and unsupported if it has no image but one of
    /// KHR_texture_basisu.
    [[nodiscard]] Result<uint32_t> read(uint32_t gltf_texture);

    std::vector<Texture> textures;
    PartList parts;

  private:
    [[nodiscard]] Result<uint32_t> find_or_decode(const GltfTexture& source);

    const GltfDocument& document_;
    GltfImages& images_;
    /// By image index and the two wrap modes.
    std::map<std::array<uint32_t, 3>, uint32_t> known_;
};

}  // namespace tetralight::detail
