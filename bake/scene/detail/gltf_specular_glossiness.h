// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_textures.h>
#include <tetralight/bake/scene/detail/texel_grid.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Base colour and metallic factor of a metallic-roughness material.
struct MetallicColor {
    glm::vec3 base_color{0.0f};
    float metallic = 0.0f;
};

/// The metallic-roughness material that reflects nearly these fractions of light: `diffuse` after
/// what the specular part leaves, and `specular` at normal incidence. It is the conversion that
/// Khronos publishes with KHR_materials_pbrSpecularGlossiness: exact for grey and for one of both
/// parts alone if `specular` is at least 0.04 (tests: `MetallicColor.*`).
[[nodiscard]] MetallicColor metallic_color(glm::vec3 diffuse, glm::vec3 specular);

/// The same of a texel that is filtered together with others: specular colours of a brightness up
/// to 0.08 are those of dielectrics, and reflect as 0.04; from 0.12 on they are as they are.
[[nodiscard]] MetallicColor metallic_color_of_texel(glm::vec3 diffuse, glm::vec3 specular);

/// Converts materials of KHR_materials_pbrSpecularGlossiness to metallic-roughness materials.
/// Materials that convert the same textures with the same factors share the converted ones.
class SpecularGlossinessReader {
  public:
    explicit SpecularGlossinessReader(GltfTextureReader& reader) : reader_(reader) {}

    /// Gives a material its base colour, metallic and roughness, with textures, which are appended
    /// to those of the reader. Where the two textures of the source have different coordinates,
    /// each is converted with the mean of the other one.
    [[nodiscard]] Status read(const GltfSpecularGlossiness& gltf, Material& material);

  private:
    struct Source;
    [[nodiscard]] Result<Source> source_from(const GltfSpecularGlossiness& gltf);
    [[nodiscard]] ConvertedSurface convert(const Source& source);

    GltfTextureReader& reader_;
    /// By the textures, whether they have the same coordinates, and the bits of the factors.
    std::map<std::vector<uint32_t>, ConvertedSurface> known_;
};

}  // namespace tetralight::detail
