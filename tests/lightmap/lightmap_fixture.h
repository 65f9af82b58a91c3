// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <glm/vec3.hpp>
#include <random>

#include <tetralight/base/half.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight::test {

/// One page of a size, all texels covered and black.
inline Lightmaps make_black_page(uint32_t page_size) {
    Lightmaps lightmaps;
    lightmaps.info.page_size = page_size;
    lightmaps.info.page_count = 1;
    lightmaps.irradiance.assign(size_t{page_size} * page_size, {{}, kCovered});
    return lightmaps;
}

inline IrradianceTexel texel_of(const glm::vec3& irradiance) {
    return {{half_from_float(irradiance.x), half_from_float(irradiance.y),
             half_from_float(irradiance.z)},
            kCovered};
}

/// Light whose vector of each channel is that of the channel's flux along a unit direction.
inline LightmapTexel light_of(const glm::vec3& flux, const glm::vec3& direction) {
    LightmapTexel texel;
    for (int channel = 0; channel < 3; ++channel) {
        const auto c = static_cast<size_t>(channel);
        texel.flux[c] = half_from_float(flux[channel]);
        for (int axis = 0; axis < 3; ++axis) {
            texel.vector[c][static_cast<size_t>(axis)] =
                half_from_float(flux[channel] * direction[axis]);
        }
    }
    return texel;
}

inline LightmapRectangle rectangle_at(uint32_t page, std::array<uint32_t, 4> texels,
                                      uint32_t page_size) {
    LightmapRectangle rectangle;
    rectangle.page = page;
    rectangle.x = texels[0];
    rectangle.y = texels[1];
    rectangle.width = texels[2];
    rectangle.height = texels[3];
    set_page_transform(rectangle, page_size);
    return rectangle;
}

/// Two pages of 4 x 4 texels with every section, random light in two layers, and three instances:
/// two with the same mesh, one without a lightmap. The light is that of the layers at weight 1.
inline Lightmaps make_full_lightmaps(uint32_t seed = 1) {
    Lightmaps lightmaps;
    lightmaps.info.page_size = 4;
    lightmaps.info.page_count = 2;
    lightmaps.info.texels_per_meter = 8.0f;
    lightmaps.info.scale = 0.25f;
    std::mt19937 random(seed);
    // Whole multiples of the scale, so that sums are exact.
    const auto value = [&] { return static_cast<float>(random() % 512); };
    for (size_t i = 0; i < lightmaps.view().texel_count(); ++i) {
        const glm::vec3 sky(value(), value(), value()), lamp(value(), value(), value());
        lightmaps.irradiance.push_back(texel_of(sky + lamp));
        lightmaps.light.push_back(light_of(2.0f * (sky + lamp), {0.0f, 0.5f, 0.0f}));
        lightmaps.layer_irradiance.push_back({texel_of(sky).rgb});
        lightmaps.layer_light.push_back(light_of(2.0f * sky, {0.0f, 0.5f, 0.0f}));
        lightmaps.validity.push_back(static_cast<uint8_t>(random()));
        lightmaps.error.push_back(half_from_float(0.01f));
        lightmaps.shadow_mask.push_back({255, static_cast<uint8_t>(i), 0, 17});
        lightmaps.ambient_occlusion.push_back(static_cast<uint8_t>(3 * i));
    }
    for (size_t i = 0; i < lightmaps.irradiance.size(); ++i) {
        const auto rest = [](uint16_t sum, uint16_t part) {
            return half_from_float(float_from_half(sum) - float_from_half(part));
        };
        LayerTexel lamp;
        for (size_t c = 0; c < 3; ++c) {
            lamp.rgb[c] =
                rest(lightmaps.irradiance[i].rgb[c], lightmaps.layer_irradiance[i].rgb[c]);
        }
        lightmaps.layer_irradiance.push_back(lamp);
        LightmapTexel light = lightmaps.light[i];
        const LightmapTexel& sky = lightmaps.layer_light[i];
        for (size_t c = 0; c < 3; ++c) {
            light.flux[c] = rest(light.flux[c], sky.flux[c]);
            for (size_t axis = 0; axis < 3; ++axis) {
                light.vector[c][axis] = rest(light.vector[c][axis], sky.vector[c][axis]);
            }
        }
        lightmaps.layer_light.push_back(light);
    }
    lightmaps.rectangles = {rectangle_at(0, {0, 0, 3, 2}, 4), rectangle_at(1, {1, 1, 3, 3}, 4), {}};
    lightmaps.rectangles[0].mesh = lightmaps.rectangles[1].mesh = 0;
    lightmaps.instance_names = "floor\nwall\nlamp\n";
    lightmaps.meshes = {{0x123456789abcdef0u, 0, 1, {}}};
    lightmaps.corner_uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
    lightmaps.layers = {{1.0f, 0.25f, {}}, {1.0f, 0.25f, {}}};
    lightmaps.layer_names = "sky\nlight:lamp\n";
    lightmaps.info.mixed_lighting = MixedLighting::Shadowmask;
    lightmaps.info.ambient_occlusion_distance = 0.5f;
    lightmaps.metadata = "{\"samples\":16}";
    return lightmaps;
}

/// The same with one texel: a small file with every section.
inline Lightmaps make_one_texel() {
    Lightmaps lightmaps = make_full_lightmaps();
    lightmaps.info.page_size = lightmaps.info.page_count = 1;
    lightmaps.irradiance.resize(1);
    lightmaps.light.resize(1);
    lightmaps.validity.resize(1);
    lightmaps.error.resize(1);
    lightmaps.shadow_mask.resize(1);
    lightmaps.ambient_occlusion.resize(1);
    lightmaps.layer_irradiance.resize(2);
    lightmaps.layer_light.resize(2);
    lightmaps.rectangles = {rectangle_at(0, {0, 0, 1, 1}, 1)};
    lightmaps.rectangles[0].mesh = 0;
    lightmaps.instance_names = "floor\n";
    return lightmaps;
}

}  // namespace tetralight::test
