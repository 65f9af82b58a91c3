// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_image_based_light.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <optional>

#include <tetralight/bake/image/rgbd.h>
#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_images.h>
#include <tetralight/bake/scene/image_based_light_glb.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/sh.h>
#include <tetralight/reflection/cube.h>

namespace tetralight::detail {
namespace {

/// Rows of the largest sky: what a face of 2048 texels needs.
constexpr uint32_t kMostSkyRows = 4096;
/// Rows of a sky of coefficients, whose light changes slowly.
constexpr uint32_t kSmoothSkyRows = 64;

/// Faces +X, -X, +Y, -Y, +Z, -Z with rows as in reflection/cube.h.
using CubeFaces = std::array<ImageF, kCubeFaceCount>;

std::string shown_size(const ImageF& image) {
    return str_cat(image.width, " x ", image.height);
}

/// Returns a field relative to the light.
Status check_face(const CubeFaces& faces, size_t face) {
    const ImageF& image = faces[face];
    const std::string field = str_cat(".specularImages[0][", face, "]");
    if (image.width != image.height || image.width != faces[0].width) {
        return Error{ErrorCode::Corrupt, field, shown_size(image),
                     str_cat("specularImages[0][", face, "] has ", shown_size(image),
                             " texels; faces are squares of one size")};
    }
    if (image.width <= kLargestSkyFace) return Ok{};
    return Error{
        ErrorCode::Unsupported, field, shown_size(image),
        str_cat("specularImages[0][", face, "] has ", shown_size(image), " texels; at most ",
                kLargestSkyFace, " x ", kLargestSkyFace, " are read")};
}

/// Images start with the last row of a face.
void turn_rows(ImageF& image) {
    for (uint32_t row = 0; row < image.height / 2; ++row) {
        const auto first = image.pixels.begin() + std::ptrdiff_t{row} * image.width;
        const auto last = image.pixels.end() - std::ptrdiff_t{row + 1} * image.width;
        std::swap_ranges(first, first + image.width, last);
    }
}

Result<CubeFaces> decode_faces(const GltfDocument& document, const GltfImageBasedLight& light) {
    CubeFaces faces;
    for (size_t face = 0; face < faces.size(); ++face) {
        const auto image = decode_gltf_image(document, light.images[0][face]);
        if (!image) return image.error();
        faces[face] = decode_rgbd(*image);
        if (auto status = check_face(faces, face); !status) return status.error();
        turn_rows(faces[face]);
    }
    return faces;
}

/// The four texels around a place, of which those beyond an edge are texels of the next face. At a
/// corner of the cube only three texels meet; their mean stands for the fourth.
std::array<glm::vec3, 4> texels_around(const CubeFaces& faces, uint32_t face, int left, int top) {
    const auto size = faces[face].width;
    const auto is_beyond = [size](int i) { return i < 0 || i >= static_cast<int>(size); };
    std::array<glm::vec3, 4> texels{};
    std::optional<size_t> missing;
    for (size_t i = 0; i < texels.size(); ++i) {
        const int x = left + static_cast<int>(i % 2), y = top + static_cast<int>(i / 2);
        if (is_beyond(x) && is_beyond(y)) {
            missing = i;
            continue;
        }
        const CubeTexel texel = wrapped_texel(face, x, y, size);
        texels[i] = faces[texel.face].pixels[size_t{texel.y} * size + texel.x];
    }
    if (missing) {
        texels[*missing] =
            (texels[*missing ^ 1] + texels[*missing ^ 2] + texels[*missing ^ 3]) / 3.0f;
    }
    return texels;
}

/// Bilinear, without seams between faces.
glm::vec3 sample_faces(const CubeFaces& faces, glm::vec3 direction) {
    const CubePlace place = cube_place(direction);
    const glm::vec2 at = place.uv * static_cast<float>(faces[0].width) - 0.5f;
    const glm::vec2 first = glm::floor(at);
    const glm::vec2 weight = at - first;
    const auto texels =
        texels_around(faces, place.face, static_cast<int>(first.x), static_cast<int>(first.y));
    return glm::mix(glm::mix(texels[0], texels[1], weight.x),
                    glm::mix(texels[2], texels[3], weight.x), weight.y);
}

/// An equirectangular image (Environment::image) whose pixels are means of `steps` times `steps`
/// places.
template <class RadianceOf>
ImageF make_equirectangular(uint32_t rows, uint32_t steps, RadianceOf radiance_of) {
    constexpr double kPi = std::numbers::pi;
    ImageF image{2 * rows, rows, std::vector<glm::vec3>(size_t{2} * rows * rows, glm::vec3(0.0f))};
    const double step = kPi / (rows * steps);
    const float weight = 1.0f / static_cast<float>(steps * steps);
    for (uint32_t row = 0; row < rows * steps; ++row) {
        const double angle = (row + 0.5) * step;  // from +Y
        for (uint32_t column = 0; column < 2 * rows * steps; ++column) {
            const double azimuth = (column + 0.5) * step - kPi;
            const glm::dvec3 direction(std::sin(angle) * std::cos(azimuth), std::cos(angle),
                                       std::sin(angle) * std::sin(azimuth));
            const size_t pixel = size_t{row / steps} * image.width + column / steps;
            image.pixels[pixel] += weight * radiance_of(direction);
        }
    }
    return image;
}

/// Mirrored x is the same both ways.
glm::vec3 mirrored(const glm::dvec3& direction) {
    return {-direction.x, direction.y, direction.z};
}

ImageF sky_from_faces(const CubeFaces& faces, const glm::dquat& sky_from_world) {
    const uint32_t wanted = 2 * faces[0].width, rows = sky_rows(faces[0].width);
    return make_equirectangular(rows, 2 * wanted / rows, [&](const glm::dvec3& direction) {
        return sample_faces(faces, mirrored(sky_from_world * direction));
    });
}

/// Radiance of order 2 rings below 0.
ImageF sky_from_coefficients(const std::vector<glm::dvec3>& coefficients,
                             const glm::dquat& sky_from_world) {
    IrradianceSh irradiance;
    for (size_t i = 0; i < coefficients.size(); ++i) {
        irradiance.coefficients[i] = kImageBasedLightSigns[i] * glm::vec3(coefficients[i]);
    }
    const RadianceSh radiance = radiance_from_irradiance(irradiance);
    return make_equirectangular(kSmoothSkyRows, 1, [&](const glm::dvec3& direction) {
        return glm::max(evaluate_radiance(radiance, glm::vec3(sky_from_world * direction)),
                        glm::vec3(0.0f));
    });
}

Result<float> sky_intensity(const GltfImageBasedLight& light) {
    const auto intensity = static_cast<float>(light.intensity);
    if (intensity >= 0.0f && std::isfinite(intensity)) return intensity;
    return Error{ErrorCode::Corrupt, ".intensity", str_cat(light.intensity),
                 str_cat("intensity ", light.intensity, " is negative or too large")};
}

/// The rotation of the sky in glTF's world: in the frame of the faces, whose x is mirrored, the
/// signs of rotations about y and z are the other ones.
Result<glm::dquat> sky_rotation(const GltfImageBasedLight& light) {
    const glm::dquat& q = light.rotation;
    const double length = glm::length(q);
    if (length > 0.0 && std::isfinite(length)) {
        return glm::dquat(q.w / length, q.x / length, -q.y / length, -q.z / length);
    }
    return Error{ErrorCode::Corrupt, ".rotation", str_cat(q.x, ", ", q.y, ", ", q.z, ", ", q.w),
                 str_cat("rotation has a length of ", length)};
}

/// Sums of coefficients up to this stay far from the largest float.
constexpr double kLargestCoefficient = 1e30;

Status check_coefficients(const GltfImageBasedLight& light) {
    for (size_t i = 0; i < light.irradiance_coefficients.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double value = light.irradiance_coefficients[i][channel];
            if (std::abs(value) <= kLargestCoefficient) continue;
            return Error{ErrorCode::Corrupt,
                         str_cat(".irradianceCoefficients[", i, "][", channel, "]"), str_cat(value),
                         str_cat("irradianceCoefficients[", i, "][", channel, "] ", value,
                                 " is not in the range -1e30 to 1e30")};
        }
    }
    return Ok{};
}

/// Faces that can be read; none, and a warning, if there are coefficients instead.
Result<std::optional<CubeFaces>> read_faces(const GltfDocument& document,
                                            const GltfImageBasedLight& light, GltfSky& sky) {
    const std::string place = gltf_place("image-based light", light.index, light.name);
    const bool has_coefficients = light.irradiance_coefficients.size() == kShCoefficientCount;
    if (light.images.empty() && !has_coefficients) {
        return Error{ErrorCode::Corrupt, ".specularImages", "",
                     "has no images, and not the nine irradianceCoefficients"};
    }
    std::string reason = "it has no images";
    if (!light.images.empty()) {
        auto faces = decode_faces(document, light);
        if (faces) return std::optional(std::move(*faces));
        const Error& error = faces.error();
        if (error.code != ErrorCode::Unsupported || !has_coefficients) return error;
        const std::string value = error.value.empty() ? "" : str_cat(" (", error.value, ")");
        reason = str_cat(error.field, value, " is of a format that is not read");
    }
    sky.parts.add({PartUse::Approximated,
                   "image-based sky",
                   0,
                   {},
                   str_cat("is that of the irradianceCoefficients, without detail: ", reason),
                   "",
                   true},
                  place);
    return std::optional<CubeFaces>();
}

Result<GltfSky> read_sky(const GltfDocument& document, const GltfImageBasedLight& light) {
    GltfSky sky;
    const auto intensity = sky_intensity(light);
    if (!intensity) return intensity.error();
    const auto rotation = sky_rotation(light);
    if (!rotation) return rotation.error();
    if (auto status = check_coefficients(light); !status) return status.error();
    const auto faces = read_faces(document, light, sky);
    if (!faces) return faces.error();
    if (*intensity == 0.0f) return sky;
    sky.environment.radiance = glm::vec3(*intensity);
    glm::dquat sky_from_world = glm::conjugate(*rotation);
    if (rotation->x == 0.0 && rotation->z == 0.0) {
        sky.environment.rotation_radians =
            static_cast<float>(2.0 * std::atan2(rotation->y, rotation->w));
        sky_from_world = glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
    sky.environment.image =
        *faces ? sky_from_faces(**faces, sky_from_world)
               : sky_from_coefficients(light.irradiance_coefficients, sky_from_world);
    return sky;
}

}  // namespace

uint32_t sky_rows(uint32_t face_size) {
    return face_size > kMostSkyRows / 2 ? kMostSkyRows : 2 * face_size;
}

Result<GltfSky> read_image_based_light(const GltfDocument& document,
                                       const GltfImageBasedLight& light) {
    auto sky = read_sky(document, light);
    if (!sky) return in_element(sky.error(), "image-based lights", light.index, light.name);
    return sky;
}

}  // namespace tetralight::detail
