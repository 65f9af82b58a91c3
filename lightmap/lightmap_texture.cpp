// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmap_texture.h>

namespace tetralight {

std::vector<TextureHalves> make_light_texture(const LightmapsView& lightmaps) {
    const std::span light = lightmaps.light;
    if (light.size() != lightmaps.texel_count()) return {};
    const size_t page_texels = size_t{lightmaps.info.page_size} * lightmaps.info.page_size;
    std::vector<TextureHalves> texture(3 * light.size());
    for (size_t i = 0; i < light.size(); ++i) {
        const size_t page = i / page_texels, texel = i % page_texels;
        for (size_t channel = 0; channel < 3; ++channel) {
            const auto& [x, y, z] = light[i].vector[channel];
            texture[(3 * page + channel) * page_texels + texel] = {x, y, z, light[i].flux[channel]};
        }
    }
    return texture;
}

}  // namespace tetralight
