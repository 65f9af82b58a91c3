// SPDX-License-Identifier: Apache-2.0
// The texture that the WebGL renderer of three.js r187 reads of a light with `isLightProbeGrid`
// (examples/jsm/lighting/LightProbeGridWebGL.js): seven volumes of RGBA texels one after the other
// along z, each with a copy of its first and its last slice. They hold 27 coefficients of radiance.
#include <algorithm>
#include <bit>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/escape.h>
#include <tetralight/engines/sampled_grid.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kTexels = 7;

void append_float(std::string& bytes, float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 255);
}

std::string texture(const SampledGrid& grid) {
    std::vector<RadianceSh> radiance;
    for (const IrradianceSh& light : grid.light)
        radiance.push_back(radiance_from_irradiance(light));
    std::string bytes;
    const uint32_t cells_of_slice = grid.resolution.x * grid.resolution.y;
    for (uint32_t texel = 0; texel < kTexels; ++texel) {
        for (uint32_t slice = 0; slice < grid.resolution.z + 2; ++slice) {
            const uint32_t z = std::min(std::max(slice, 1u) - 1, grid.resolution.z - 1);
            for (uint32_t i = 0; i < cells_of_slice; ++i) {
                const float* light = &radiance[size_t{z} * cells_of_slice + i].coefficients[0].x;
                for (uint32_t k = 4 * texel; k < 4 * texel + 4; ++k) {
                    append_float(bytes, k < 3 * kShCoefficientCount ? light[k] : 0.0f);
                }
            }
        }
    }
    return bytes;
}

std::string triple(const auto& v) {
    return str_cat('[', xyz_text(v), ']');
}

}  // namespace

Result<ExportedVolume> export_three_grid(const ProbeVolumeView& volume,
                                         const ExportSettings& settings) {
    const auto grid = sample_grid(volume, settings);
    if (!grid) return grid.error();
    const std::string data_name = settings.name + ".bin";
    const std::string header =
        str_cat("{\n  \"format\": \"tetralight three grid\",\n  \"version\": 1,\n  \"min\": ",
                triple(grid->bounds.min), ",\n  \"max\": ", triple(grid->bounds.max),
                ",\n  \"resolution\": ", triple(grid->resolution), ",\n  \"texture\": ",
                triple(glm::uvec3(grid->resolution.x, grid->resolution.y,
                                  kTexels * (grid->resolution.z + 2))),
                ",\n  \"data\": ", quoted_for_json(data_name), "\n}\n");
    return ExportedVolume{{{settings.name + ".json", header}, {data_name, texture(*grid)}},
                          {},
                          measure_difference(volume, *grid)};
}

}  // namespace tetralight::detail
