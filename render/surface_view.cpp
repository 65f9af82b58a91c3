// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/surface_view.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/render/health_balls.h>

namespace tetralight {
namespace {

/// Hues that differ for neighbouring numbers: steps of the golden ratio around the colour circle.
glm::vec3 hue_of(uint32_t number) {
    const double turn = std::fmod(number * std::numbers::phi, 1.0);
    glm::vec3 color;
    for (int i = 0; i < 3; ++i) {
        const double wave = std::cos(2.0 * std::numbers::pi * (turn - i / 3.0));
        color[i] = static_cast<float>(0.6 + 0.3 * wave);
    }
    return color;
}

/// The texel that holds a place of its page.
glm::uvec2 texel_of(const LightmapsView& lightmaps, glm::vec2 uv_page) {
    const auto size = static_cast<float>(lightmaps.info.page_size);
    const glm::vec2 place(std::clamp(uv_page.x * size, 0.0f, size - 1.0f),
                          std::clamp(uv_page.y * size, 0.0f, size - 1.0f));
    return {static_cast<uint32_t>(place.x), static_cast<uint32_t>(place.y)};
}

}  // namespace

glm::vec3 lightmap_color(SurfaceView view, const LightmapsView& lightmaps, uint32_t instance,
                         glm::vec2 uv_page) {
    const LightmapRectangle& rectangle = lightmaps.rectangles[instance];
    const glm::uvec2 texel = texel_of(lightmaps, uv_page);
    switch (view) {
        case SurfaceView::UnwrappedUv:
            return {(uv_page - rectangle.offset) / rectangle.scale, 0.0f};
        case SurfaceView::LightmapUv:
            return {uv_page, 0.0f};
        case SurfaceView::Texels:
            return hue_of(instance) * ((texel.x + texel.y) % 2 == 0 ? 1.0f : 0.55f);
        case SurfaceView::Pages:
            return hue_of(rectangle.page);
        case SurfaceView::Validity: {
            const uint64_t index = lightmaps.info.texel_index(rectangle.page, texel.x, texel.y);
            if (index >= lightmaps.validity.size()) break;
            return validity_color(static_cast<float>(lightmaps.validity[index]) / 255.0f);
        }
        case SurfaceView::ShadowMask:
            return glm::vec3(sample_shadow_mask(lightmaps, rectangle.page, uv_page));
        case SurfaceView::AmbientOcclusion:
            return glm::vec3(sample_ambient_occlusion(lightmaps, rectangle.page, uv_page));
        default:
            break;
    }
    return glm::vec3(0.6f);
}

}  // namespace tetralight
