// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reflection_images.h>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {
namespace {

/// Faces [first, first + count) of a cube.
ImageF stacked_faces(const ReflectionsView& reflections, size_t probe, uint32_t level,
                     uint32_t first, uint32_t count) {
    const uint32_t size = reflections.size >> level;
    const size_t texel_count = size_t{size} * size;
    const auto texels = reflections.levels[level].subspan(
        (probe * kCubeFaceCount + first) * texel_count, count * texel_count);
    ImageF image{size, size * count, {}};
    image.pixels.reserve(texels.size());
    for (const RadianceTexel& texel : texels) {
        image.pixels.emplace_back(float_from_half(texel[0]), float_from_half(texel[1]),
                                  float_from_half(texel[2]));
    }
    return image;
}

}  // namespace

ImageF face_image(const ReflectionsView& reflections, size_t probe, uint32_t level, uint32_t face) {
    return stacked_faces(reflections, probe, level, face, 1);
}

ImageF cube_strip(const ReflectionsView& reflections, size_t probe, uint32_t level) {
    return stacked_faces(reflections, probe, level, 0, kCubeFaceCount);
}

}  // namespace tetralight
