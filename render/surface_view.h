// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <tetralight/lightmap/lightmaps.h>

// Pictures that explain light: parts of it, and what lightmaps hold.

namespace tetralight {

/// What a picture shows of surfaces.
enum class SurfaceView : uint8_t {
    Shaded,  ///< light and materials, as in an engine

    // Parts of the light: exposed and tone-mapped.
    Received,  ///< all light on white surfaces, without emission
    Direct,    ///< what surfaces reflect of lights that are not baked
    Bounce,    ///< what surfaces reflect of baked light: lightmaps and probes
    Emission,

    // Colours: sRGB-encoded, without exposure.
    Albedo,
    Normal,       ///< red, green, blue: x, y and z of the normal with its map, −1 to 1
    UnwrappedUv,  ///< red, green: UVs of the mesh, 0 to 1 in the rectangle of each object
    LightmapUv,   ///< red, green: UVs of the page, after scale and offset
    Texels,       ///< a chessboard of texels, in one hue an object
    Validity,     ///< of texels, in the colours of `health_color`; grey = not known
    Pages,        ///< a hue for each page
    ShadowMask,   ///< red, green, blue: how much of the lights of the first three channels is seen
    AmbientOcclusion,  ///< white = open surroundings
};

/// True for parts of the light, which need an exposure.
[[nodiscard]] constexpr bool is_light(SurfaceView view) {
    return view <= SurfaceView::Emission;
}

/// True for what only lightmaps have.
[[nodiscard]] constexpr bool needs_lightmaps(SurfaceView view) {
    return view >= SurfaceView::UnwrappedUv;
}

/// The colour of a place of a lightmap, sRGB-encoded, 0 to 1. Precondition: the view needs
/// lightmaps, and the instance has a page.
[[nodiscard]] glm::vec3 lightmap_color(SurfaceView view, const LightmapsView& lightmaps,
                                       uint32_t instance, glm::vec2 uv_page);

}  // namespace tetralight
