// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reflection_images.h>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {

ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level) {
    const uint32_t size = reflections.size >> level;
    const size_t count = size_t{kCubeFaceCount} * size * size;
    ImageF image{size, size * kCubeFaceCount, {}};
    image.pixels.reserve(count);
    for (const RadianceTexel& texel : reflections.levels[level].subspan(probe * count, count)) {
        image.pixels.emplace_back(float_from_half(texel[0]), float_from_half(texel[1]),
                                  float_from_half(texel[2]));
    }
    return image;
}

}  // namespace tetralight
