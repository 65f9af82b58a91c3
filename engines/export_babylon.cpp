// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include <tetralight/bake/image/rgbd.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/scene/image_based_light_glb.h>
#include <tetralight/base/utf8.h>
#include <tetralight/engines/detail/place_light.h>
#include <tetralight/engines/detail/targets.h>

namespace tetralight::detail {
namespace {

/// Texels along a side of a face. Nine coefficients have no finer detail.
constexpr uint32_t kSize = 16;
constexpr uint32_t kLevels = 5;  // 16, 8, 4, 2, 1
constexpr uint32_t kFaces = 6;

/// What a surface reflects of light that is known by nine coefficients: the light itself if it is a
/// mirror, and as much as a white diffuse surface if it is as rough as can be.
struct Reflected {
    RadianceSh mirror;
    IrradianceSh rough;

    explicit Reflected(const IrradianceSh& light)
        : mirror(radiance_from_irradiance(light)), rough(light) {}

    [[nodiscard]] glm::vec3 at(const glm::vec3& direction, float roughness) const {
        const glm::vec3 light =
            (1.0f - roughness) * evaluate_radiance(mirror, direction) +
            roughness * std::numbers::inv_pi_v<float> * evaluate_irradiance(rough, direction);
        return {std::max(light.x, 0.0f), std::max(light.y, 0.0f), std::max(light.z, 0.0f)};
    }
};

using Faces = std::array<ImageF, kFaces>;

Faces faces_of(const Reflected& light, uint32_t level) {
    const uint32_t size = kSize >> level;
    const float roughness = static_cast<float>(level) / static_cast<float>(kLevels - 1);
    Faces faces;
    for (uint32_t face = 0; face < kFaces; ++face) {
        faces[face] = {size, size, {}};
        for (uint32_t i = 0; i < size * size; ++i) {
            const glm::vec3 direction = image_based_light_direction(face, i % size, i / size, size);
            faces[face].pixels.push_back(light.at(direction, roughness));
        }
    }
    return faces;
}

float largest_channel(const std::vector<Faces>& levels) {
    float largest = 0.0f;
    for (const Faces& faces : levels) {
        for (const ImageF& image : faces) {
            for (const glm::vec3& p : image.pixels) largest = std::max({largest, p.x, p.y, p.z});
        }
    }
    return largest;
}

/// Adds the images, ÷ the intensity.
Status encode(const std::vector<Faces>& levels, GltfImageBasedLight& light) {
    for (const Faces& faces : levels) {
        auto& encoded = light.levels.emplace_back();
        for (size_t face = 0; face < kFaces; ++face) {
            ImageF image = faces[face];
            for (glm::vec3& p : image.pixels) p /= light.intensity;
            auto bytes = encode_png(encode_rgbd(image));
            if (!bytes) return bytes.error();
            encoded[face] = std::move(*bytes);
        }
    }
    return Ok{};
}

}  // namespace

Result<ExportedVolume> export_babylon(const ProbeVolumeView& volume,
                                      const ExportSettings& settings) {
    const auto place = light_of_one_place(volume, settings);
    if (!place) return place.error();
    const Reflected reflected(place->light);
    std::vector<Faces> levels;
    for (uint32_t level = 0; level < kLevels; ++level) {
        levels.push_back(faces_of(reflected, level));
    }
    GltfImageBasedLight light;
    if (is_utf8(settings.name)) light.name = settings.name;
    light.is_sky = false;
    light.size = kSize;
    light.intensity = intensity_for_rgbd(largest_channel(levels));
    light.irradiance_coefficients = coefficients_of(kBabylonSh, place->light);
    for (glm::vec3& c : light.irradiance_coefficients) c /= light.intensity;
    if (auto status = encode(levels, light); !status) return status.error();
    const auto glb = make_image_based_light_glb(light);
    if (!glb) return glb.error();
    std::string bytes(reinterpret_cast<const char*>(glb->data()), glb->size());
    return ExportedVolume{
        {{settings.name + ".glb", std::move(bytes)}}, {other_places_are_lost(*place)}, {}};
}

}  // namespace tetralight::detail
