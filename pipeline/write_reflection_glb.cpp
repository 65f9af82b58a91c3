// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_reflection_glb.h>

#include <algorithm>
#include <utility>

#include <tetralight/bake/image/rgbd.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/scene/image_based_light_glb.h>
#include <tetralight/base/file.h>
#include <tetralight/pipeline/reflection_images.h>
#include <tetralight/reflection/cube.h>
#include <tetralight/reflection/sample_reflections.h>

namespace tetralight {
namespace {

/// The image of a face as the extension has it. The roughness of a level is level / (levels - 1),
/// as readers of the extension look levels up, so that it is a blend of ours.
ImageF face_image(const ReflectionsView& all, size_t probe, uint32_t level, uint32_t face) {
    const uint32_t size = all.size >> level;
    const float roughness =
        all.level_count < 2 ? 0.0f
                            : static_cast<float>(level) / static_cast<float>(all.level_count - 1);
    ImageF image{size, size, {}};
    for (uint32_t i = 0; i < size * size; ++i) {
        const glm::vec3 direction = image_based_light_direction(face, i % size, i / size, size);
        image.pixels.push_back(
            sample_cube(all, static_cast<uint32_t>(probe), direction, roughness));
    }
    return image;
}

float largest_channel(const ReflectionsView& all, size_t probe) {
    float largest = 0.0f;
    for (uint32_t level = 0; level < all.level_count; ++level) {
        for (const glm::vec3& light : cube_strip(all, probe, level).pixels)
            largest = std::max({largest, light.x, light.y, light.z});
    }
    return largest;
}

Result<GltfImageBasedLight> make_light(const ReflectionsView& all, size_t probe,
                                       const std::string& name) {
    GltfImageBasedLight light;
    light.name = name;
    light.is_sky = all.probes[probe].is_everywhere();
    light.intensity = intensity_for_rgbd(largest_channel(all, probe));
    light.size = all.size;
    const auto& irradiance = all.probes[probe].irradiance.coefficients;
    for (size_t i = 0; i < irradiance.size(); ++i)
        light.irradiance_coefficients[i] =
            kImageBasedLightSigns[i] / light.intensity * irradiance[i];
    light.levels.resize(all.level_count);
    for (uint32_t level = 0; level < all.level_count; ++level) {
        for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
            ImageF image = face_image(all, probe, level, face);
            for (glm::vec3& texel : image.pixels) texel /= light.intensity;
            auto bytes = encode_png(encode_rgbd(image));
            if (!bytes) return bytes.error();
            light.levels[level][face] = std::move(*bytes);
        }
    }
    return light;
}

}  // namespace

Result<float> write_reflection_glb(const std::string& path, const std::string& scene_path,
                                   const ReflectionsView& reflections, size_t probe,
                                   const std::string& light_name) {
    const auto light = make_light(reflections, probe, light_name);
    if (!light) return light.error();
    const auto bytes = make_image_based_light_glb(scene_path, *light);
    if (!bytes) return bytes.error();
    if (auto status = write_file(path, *bytes); !status) return status.error();
    return light->intensity;
}

}  // namespace tetralight
