// SPDX-License-Identifier: Apache-2.0
// Light for a material function of Unreal Engine: a sheet of tiles, from which the editor makes one
// volume texture, and a page with the code of the function. The seven float4 of `PackedSh` follow
// each other along the depth of the volume. Tiles are its slices, row by row from the top left, as
// UVolumeTexture::UpdateSourceFromSourceTexture takes them.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <tetralight/bake/image/write_layered_exr.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/half_scale.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/escape.h>
#include <tetralight/engines/sampled_grid.h>
#include <tetralight/probes/packed_sh.h>

namespace tetralight::detail {
namespace {

/// Volumes along the depth of the texture: the members of `PackedSh`.
constexpr uint32_t kSlabs = 7;

/// Slices of a volume texture that Unreal makes from a sheet.
constexpr uint32_t kMostSlices = 512;

/// Pixels of a texture along each axis.
constexpr uint32_t kMostSheetPixels = 8192;

/// Tiles side by side and one below the other; together one for each slice.
struct Sheet {
    uint32_t columns = 0;
    uint32_t rows = 0;
};

/// The sheet that is nearest to a square; none if none is small enough.
std::optional<Sheet> choose_sheet(const glm::uvec3& resolution) {
    const uint32_t slices = kSlabs * resolution.z;
    std::optional<Sheet> best;
    uint64_t best_size = kMostSheetPixels + 1;
    for (uint32_t columns = 1; columns <= slices; ++columns) {
        if (slices % columns != 0) continue;
        const uint64_t size =
            std::max(uint64_t{columns} * resolution.x, uint64_t{slices / columns} * resolution.y);
        if (size >= best_size) continue;
        best_size = size;
        best = Sheet{columns, slices / columns};
    }
    return slices <= kMostSlices ? best : std::nullopt;
}

std::vector<PackedSh> packed_light(const SampledGrid& grid) {
    std::vector<PackedSh> packed;
    packed.reserve(grid.light.size());
    for (const IrradianceSh& light : grid.light) packed.push_back(pack_sh(light));
    return packed;
}

float largest_number(const std::vector<PackedSh>& light) {
    float largest = 0.0f;
    for (const PackedSh& packed : light) {
        const std::span numbers(&packed.sha_r.x, sizeof(PackedSh) / sizeof(float));
        for (const float number : numbers) largest = std::max(largest, std::abs(number));
    }
    return largest;
}

/// The texels of the sheet, ÷ `scale`.
std::vector<glm::vec4> sheet_texels(const SampledGrid& grid, const std::vector<PackedSh>& light,
                                    const Sheet& sheet, float scale) {
    const glm::uvec3& size = grid.resolution;
    std::vector<glm::vec4> texels(kSlabs * light.size());
    for (uint32_t slice = 0; slice < kSlabs * size.z; ++slice) {
        const uint32_t slab = slice / size.z;
        const size_t first = size_t{slice % size.z} * size.x * size.y;
        const uint32_t left = slice % sheet.columns * size.x;
        const uint32_t top = slice / sheet.columns * size.y;
        for (uint32_t y = 0; y < size.y; ++y) {
            const size_t row = size_t{top + y} * sheet.columns * size.x + left;
            for (uint32_t x = 0; x < size.x; ++x) {
                const PackedSh& packed = light[first + size_t{y} * size.x + x];
                texels[row + x] = (&packed.sha_r)[slab] / scale;
            }
        }
    }
    return texels;
}

Result<std::string> sheet_image(const std::vector<glm::vec4>& texels, uint32_t width) {
    LayeredImage image{width, static_cast<uint32_t>(texels.size() / width), {}, {}};
    constexpr std::array kNames{"R", "G", "B", "A"};
    for (int channel = 0; channel < 4; ++channel) {
        image.channels.push_back(
            {kNames[static_cast<size_t>(channel)], &texels[0][channel], sizeof(glm::vec4)});
    }
    return encode_layered_exr(image, ExrPrecision::Half);
}

std::string hlsl_vector(const auto& v) {
    return str_cat("float3(", xyz_text(v), ')');
}

/// The code of a Custom node.
std::string material_code(const SampledGrid& grid, float scale) {
    return str_cat("const float3 BoxMin = ", hlsl_vector(grid.bounds.min),
                   ";\nconst float3 BoxSize = ", hlsl_vector(grid.bounds.size()),
                   ";\nconst float3 Cells = ", hlsl_vector(grid.resolution),
                   ";\nconst float Scale = ", scale, R"(;
// From centimetres with Z up to metres with Y up.
float3 P = Position.xzy * 0.01;
float3 N = normalize(Normal).xzy;
float3 Place = clamp((P - BoxMin) / BoxSize * Cells, 0.5, Cells - 0.5);
float3 UVW = Place / (Cells * float3(1, 1, 7));
float4 Sh[7];
for (int i = 0; i < 7; ++i)
{
    Sh[i] = Texture3DSampleLevel(Probes, ProbesSampler, UVW + float3(0, 0, i / 7.0), 0);
}
float4 N1 = float4(N, 1);
float4 N2 = N.xyzz * N.yzzx;
float3 Light = float3(dot(Sh[0], N1), dot(Sh[1], N1), dot(Sh[2], N1));
Light += float3(dot(Sh[3], N2), dot(Sh[4], N2), dot(Sh[5], N2));
Light += Sh[6].rgb * (N.x * N.x - N.y * N.y);
return max(Light * Scale, 0);
)");
}

/// How the editor makes a material function of it.
std::string material_page(const SampledGrid& grid, const std::string& sheet_name, float scale) {
    return str_cat("# Probe light in Unreal Engine\n\n1. Import ", quoted_for_json(sheet_name), R"(.
   In its settings: Compression Settings `HDR (RGBA16F)`, sRGB off, Mip Gen Settings `NoMipmaps`.
2. Create a volume texture from it. Source 2D Texture: the sheet; Tile Size X )",
                   grid.resolution.x, ", Tile Size Y ", grid.resolution.y, R"(. Its size is )",
                   grid.resolution.x, " x ", grid.resolution.y, " x ", kSlabs * grid.resolution.z,
                   R"(. Compression, sRGB and mips as above.
3. In a material function, add a Custom node with output type `CMOT Float 3` and the code below. Its
   inputs: `Probes` (a Texture Object of the volume texture), `Position` (Absolute World Position)
   and `Normal` (PixelNormalWS, or VertexNormalWS for one value a vertex).
4. Its output is irradiance / pi. Multiply it by the base color and by the ambient occlusion of the
   material, and connect that with Emissive Color.

The box is in metres with Y up, where the importer of glTF puts the scene. Beyond the box the light
of its border continues.

```hlsl
)",
                   material_code(grid, scale), "```\n");
}

}  // namespace

Result<ExportedVolume> export_unreal(const ProbeVolumeView& volume,
                                     const ExportSettings& settings) {
    const auto grid = sample_grid(volume, settings);
    if (!grid) return grid.error();
    const auto sheet = choose_sheet(grid->resolution);
    if (!sheet) {
        return Error{
            ErrorCode::InvalidArgument, settings.resolution[0] > 0 ? "resolution" : "spacing", "",
            str_cat("gives ", grid->resolution.x, " x ", grid->resolution.y, " x ",
                    grid->resolution.z, " cells; up to ", kMostSlices / kSlabs,
                    " along z, and sheets of ", kMostSheetPixels, " pixels a side, are possible")};
    }
    const std::vector<PackedSh> light = packed_light(*grid);
    const float scale = half_scale(largest_number(light));
    const auto image =
        sheet_image(sheet_texels(*grid, light, *sheet, scale), sheet->columns * grid->resolution.x);
    if (!image) return image.error();
    const std::string sheet_name = settings.name + ".exr";
    return ExportedVolume{
        {{settings.name + ".md", material_page(*grid, sheet_name, scale)}, {sheet_name, *image}},
        {},
        measure_difference(volume, *grid)};
}

}  // namespace tetralight::detail
