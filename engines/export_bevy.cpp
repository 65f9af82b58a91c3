// SPDX-License-Identifier: Apache-2.0
// The irradiance volume of Bevy 0.19: a 3D texture of ambient cubes (Mitchell 2006, "Shading in
// Valve's Source Engine"), and a world of one entity that places it. The texture of a grid of
// (x, y, z) cells has (x, 2 y, 3 z) texels: along its depth the axes x, y, z, in the first half of
// its height light on surfaces that face along the axis, in the second half against it. That is
// how the shader (bevy_pbr, irradiance_volume.wgsl) reads it. Its texels are irradiance / π.
#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <numbers>

#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/half_scale.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/escape.h>
#include <tetralight/engines/sampled_grid.h>

namespace tetralight::detail {
namespace {

/// The largest 3D texture of every device (WebGPU, limit maxTextureDimension3D).
constexpr uint32_t kMostTextureTexels = 2048;

/// Irradiance of surfaces that face along the axes x, y, z, and against them.
using AmbientCube = std::array<std::array<glm::vec3, 3>, 2>;

AmbientCube ambient_cube(const IrradianceSh& light) {
    AmbientCube cube;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 normal(0.0f);
        normal[axis] = 1.0f;
        cube[0][static_cast<size_t>(axis)] = evaluate_irradiance(light, normal);
        cube[1][static_cast<size_t>(axis)] = evaluate_irradiance(light, -normal);
    }
    return cube;
}

/// What Bevy shows, times π.
glm::vec3 cube_irradiance(const AmbientCube& cube, const glm::vec3& normal) {
    glm::vec3 sum(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const float n = normal[axis];
        sum += n * n * cube[n < 0.0f ? 1 : 0][static_cast<size_t>(axis)];
    }
    return sum;
}

/// The texels of the texture, not yet as halves.
std::vector<glm::vec3> texels_of(const SampledGrid& grid) {
    const glm::uvec3 size = grid.resolution * glm::uvec3(1, 2, 3);
    std::vector<glm::vec3> texels(size_t{size.x} * size.y * size.z);
    for (uint32_t z = 0; z < grid.resolution.z; ++z) {
        for (uint32_t y = 0; y < grid.resolution.y; ++y) {
            for (uint32_t x = 0; x < grid.resolution.x; ++x) {
                const AmbientCube cube = ambient_cube(grid.at(x, y, z));
                for (uint32_t side = 0; side < 6; ++side) {
                    const size_t row = y + side / 3 * grid.resolution.y;
                    const size_t slice = z + side % 3 * grid.resolution.z;
                    texels[(slice * size.y + row) * size.x + x] =
                        cube[side / 3][side % 3] * std::numbers::inv_pi_v<float>;
                }
            }
        }
    }
    return texels;
}

std::string texture_file(const SampledGrid& grid, const std::vector<glm::vec3>& texels,
                         float scale) {
    std::vector<std::array<uint16_t, 4>> halves;
    halves.reserve(texels.size());
    for (const glm::vec3& texel : texels) {
        const glm::vec3 value = texel / scale;
        halves.push_back({half_from_float_saturated(value.r), half_from_float_saturated(value.g),
                          half_from_float_saturated(value.b), half_from_float(1.0f)});
    }
    const glm::uvec3 size = grid.resolution * glm::uvec3(1, 2, 3);
    return encode_ktx2(
        {size.x, size.y, size.z, TexelFormat::Rgba16Float, std::as_bytes(std::span(halves))}, {});
}

/// A number of RON that nothing takes for an integer.
std::string ron_number(auto value) {
    std::string text = str_cat(value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string ron_triple(const glm::dvec3& v) {
    return str_cat('(', ron_number(v.x), ", ", ron_number(v.y), ", ", ron_number(v.z), ')');
}

/// A world as `WorldAssetLoader` of Bevy reads it.
std::string world_file(const Box<glm::dvec3>& box, const std::string& texture_name,
                       float intensity) {
    return str_cat(R"((
  resources: {},
  entities: {
    4294967297: (
      components: {
        "bevy_light::probe::IrradianceVolume": (
          voxels: Path()",
                   quoted_for_ron(texture_name), R"(),
          intensity: )",
                   ron_number(intensity), R"(,
          affects_lightmapped_meshes: true,
        ),
        "bevy_light::probe::LightProbe": (
          falloff: (0.0, 0.0, 0.0),
        ),
        "bevy_transform::components::transform::Transform": (
          translation: )",
                   ron_triple(box.center()), R"(,
          rotation: (0.0, 0.0, 0.0, 1.0),
          scale: )",
                   ron_triple(box.size()), R"(,
        ),
      },
    ),
  },
)
)");
}

/// Bevy takes what follows # in the path of an asset for a label, and what precedes : for a source.
std::string asset_name(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c == '#' || c == ':'; }, '_');
    return name;
}

Status check_resolution(const SampledGrid& grid, const ExportSettings& settings) {
    const glm::uvec3 size = grid.resolution * glm::uvec3(1, 2, 3);
    if (std::max({size.x, size.y, size.z}) <= kMostTextureTexels) return Ok{};
    return Error{ErrorCode::InvalidArgument, settings.resolution[0] > 0 ? "resolution" : "spacing",
                 "",
                 str_cat("gives a texture of ", size.x, " x ", size.y, " x ", size.z,
                         " texels; up to ", kMostTextureTexels, " along each axis are possible")};
}

}  // namespace

Result<ExportedVolume> export_bevy(const ProbeVolumeView& volume, const ExportSettings& settings) {
    const auto grid = sample_grid(volume, settings);
    if (!grid) return grid.error();
    if (auto status = check_resolution(*grid, settings); !status) return status.error();
    const std::vector<glm::vec3> texels = texels_of(*grid);
    float largest = 0.0f;
    for (const glm::vec3& texel : texels) {
        const glm::vec3 value = glm::abs(texel);
        largest = std::max({largest, value.r, value.g, value.b});
    }
    const float scale = half_scale(largest);
    const std::string texture_name = asset_name(settings.name) + ".ktx2";
    return ExportedVolume{
        {{settings.name + ".scn.ron", world_file(grid->bounds, texture_name, scale)},
         {texture_name, texture_file(*grid, texels, scale)}},
        {},
        measure_difference(volume, random_places(volume, kDifferencePlaces, grid->bounds),
                           [&](const glm::dvec3& position) -> IrradianceByNormal {
                               return [cube = ambient_cube(grid->sample(position))](
                                          const glm::vec3& normal) {
                                   return cube_irradiance(cube, normal);
                               };
                           })};
}

}  // namespace tetralight::detail
