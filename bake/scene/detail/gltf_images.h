// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// An image that becomes a texture of the scene, and glTF's codes of its wrap modes.
struct GltfImageUse {
    uint32_t image = 0;
    uint32_t wrap_s = 0;
    uint32_t wrap_t = 0;

    auto operator<=>(const GltfImageUse&) const = default;
};

/// For each image of the document the first one with the same bytes by reference: the same buffer
/// view, file or data URI.
[[nodiscard]] std::vector<uint32_t> images_alike(const GltfDocument& document);

/// The images that materials use, the first of those alike: once for each pair of wrap modes, and
/// once more as a normal map.
[[nodiscard]] std::vector<GltfImageUse> image_uses(const GltfDocument& document,
                                                   NormalMaps normal_maps);

/// The size of an image by its header. Errors name the image.
[[nodiscard]] Result<ImageSize> gltf_image_size(const GltfDocument& document, uint32_t image);

/// Decodes an image. Errors name the image.
[[nodiscard]] Result<Image8> decode_gltf_image(const GltfDocument& document, uint32_t image);

/// The images of a document, of which several can be decoded at a time.
class GltfImages {
  public:
    explicit GltfImages(const GltfDocument& document)
        : document_(document), decoded_(document.images.size()) {}

    /// Decodes these images on all processors, so that they are there when they are asked for.
    void decode_ahead(std::span<const GltfImageUse> uses);

    /// The pixels of an image. Errors name the image.
    [[nodiscard]] Result<Image8> take(uint32_t image);

    /// The first image with the same bytes by reference.
    [[nodiscard]] uint32_t first_alike(uint32_t image) const { return alike_[image]; }

  private:
    const GltfDocument& document_;
    std::vector<uint32_t> alike_ = images_alike(document_);
    std::vector<std::optional<Result<Image8>>> decoded_;
};

}  // namespace tetralight::detail
