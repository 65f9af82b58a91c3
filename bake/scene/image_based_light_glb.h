// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

/// Factors between irradiance E_i (docs/conventions.md) of glTF's world and coefficients of
/// EXT_lights_image_based, either way. Babylon.js (sphericalPolynomial.ts) has the Condon-Shortley
/// phase, minus for odd m, and shows the light in a world whose x is mirrored, which turns the
/// signs of x and xz back, and that of xy.
inline constexpr std::array<float, 9> kImageBasedLightSigns{1, -1, 1, 1, -1, -1, 1, 1, 1};

/// A light of the glTF extension EXT_lights_image_based, as the extension encodes and orders it.
struct GltfImageBasedLight {
    std::string name;
    /// Factor on the light of the images and of the coefficients.
    float intensity = 1.0f;
    /// False if the light is that of a place in the scene: `read_gltf` does not take it for the sky
    /// (`extras.sky: false` of the light).
    bool is_sky = true;
    std::array<glm::vec3, 9> irradiance_coefficients{};
    /// Texels along a side of a face of level 0, a power of two.
    uint32_t size = 0;
    /// PNG images of the six faces of each level.
    std::vector<std::array<std::vector<std::byte>, 6>> levels;
};

/// The glTF scene at `path` with one more light, as the bytes of a .glb file with all buffers and
/// images in it. The file's default scene uses this light instead of the one that it had.
/// Everything else stays.
///
/// Returns the errors of reading the file; corrupt if a member on the way to the light is of
/// another type than the extension says; invalid_argument (field "scenes") if there is no scene.
[[nodiscard]] Result<std::vector<std::byte>> make_image_based_light_glb(
    const std::string& path, const GltfImageBasedLight& light);

/// A glTF scene that has nothing but this light, as the bytes of a .glb file.
[[nodiscard]] Result<std::vector<std::byte>> make_image_based_light_glb(
    const GltfImageBasedLight& light);

/// The direction in glTF's world of the light in pixel (x, y) of the image of a face, as Babylon.js
/// shows it in left-handed scenes. These have x mirrored, which exchanges the faces of x and
/// mirrors columns; images start with the last row. Precondition: face < 6, x and y < size.
[[nodiscard]] glm::vec3 image_based_light_direction(uint32_t face, uint32_t x, uint32_t y,
                                                    uint32_t size) noexcept;

}  // namespace tetralight
