// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_specular_glossiness.h>
#include <tetralight/bake/scene/detail/gltf_textures.h>
#include <tetralight/bake/scene/detail/texel_grid.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A surface that lets light through, as one that covers a part of itself (`AlphaMode::Blend`).
struct PartlyCovering {
    /// Of the part that covers.
    MetallicColor color;
    /// The fraction of light that does not shine through.
    float opacity = 1.0f;
};

/// KHR_materials_transmission at a point. Of the light that a dielectric does not mirror, 0.96, a
/// fraction `transmission` times the base colour shines through, which is here its luminance in all
/// three channels. The rest of the surface reflects what it did: diffusely less by `transmission`,
/// and all of the specular part. Metals let nothing through.
[[nodiscard]] PartlyCovering partly_covering(const MetallicColor& color, float transmission);

/// Gives materials of KHR_materials_transmission an alpha. Materials that convert the same textures
/// with the same factors share the converted ones.
class TransmissionReader {
  public:
    explicit TransmissionReader(GltfTextureReader& reader) : reader_(reader) {}

    /// Changes a material that has its other members: its base colour, alpha and metallic factor,
    /// with textures, which are appended to those of the reader. Its emission becomes stronger by
    /// as much as its opacity becomes less, in the mean. It does not change where nothing shines
    /// through. Textures have the coordinates of the base colour, or else of the transmission or
    /// the metallic factor; those with others count by their mean.
    [[nodiscard]] Status read(const GltfTransmission& gltf, Material& material);

    /// True if light shone through a coloured surface in the last call of `read`.
    [[nodiscard]] bool is_colored() const { return is_colored_; }

  private:
    struct Source;

    struct Converted {
        ConvertedSurface surface;
        /// Mean fraction of light that does not shine through; 1: the material does not change.
        float opacity = 1.0f;
        bool is_colored = false;
    };

    [[nodiscard]] Converted convert(const Source& source);

    GltfTextureReader& reader_;
    /// By the textures, their coordinates, and the bits of the factors.
    std::map<std::vector<uint32_t>, Converted> known_;
    bool is_colored_ = false;
};

}  // namespace tetralight::detail
