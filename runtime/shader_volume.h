// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>
#include <vector>

#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_volume.h>

// A probe volume for shaders: one uniform block and six arrays of 16-byte elements, ready to
// upload. runtime/shaders/query_volume.glsl declares them as storage buffers (std430), structured
// buffers, or textures with 2048 texels per row.
//
//     const ShaderVolume volume = make_shader_volume(file->view());
//     upload(volume.constants); upload(volume.positions); ...  // bindings: query_volume.glsl
//     const CellLocation location = locate(volume, position, kNoIndex);  // runtime/shader_query.h

namespace tetralight {

/// The uniform block `TetralightVolume` (std140; a constant buffer in HLSL).
struct ShaderVolumeConstants {
    glm::vec4 origin{0.0f};       ///< xyz: world position of the local origin; w: `extent`
    glm::vec4 origin_rest{0.0f};  ///< xyz: rounding error of `origin`
    glm::vec4 axis{0.0f};         ///< xyz: `VolumeInfo::axis`
    glm::vec4 seed_min{0.0f};     ///< xyz: `SeedGridHeader::min` of the outermost seed grid
    glm::vec4 seed_scale{0.0f};   ///< xyz: its `scale`
    glm::uvec4 seed_size{1};      ///< xyz: its `size`; w: words in `seeds`
    glm::uvec4 counts{0};         ///< probes, cells, inner cells, `Dimension`
    glm::uvec4 walls{0};          ///< in `walls`: blocks, place of the first codes, marked cells
    PackedSh ambient{};

    bool operator==(const ShaderVolumeConstants&) const = default;
};

static_assert(sizeof(ShaderVolumeConstants) == 240 &&
              std::is_trivially_copyable_v<ShaderVolumeConstants>);
static_assert(offsetof(ShaderVolumeConstants, origin_rest) == 16);
static_assert(offsetof(ShaderVolumeConstants, axis) == 32);
static_assert(offsetof(ShaderVolumeConstants, seed_min) == 48);
static_assert(offsetof(ShaderVolumeConstants, seed_scale) == 64);
static_assert(offsetof(ShaderVolumeConstants, seed_size) == 80);
static_assert(offsetof(ShaderVolumeConstants, counts) == 96);
static_assert(offsetof(ShaderVolumeConstants, walls) == 112);
static_assert(offsetof(ShaderVolumeConstants, ambient) == 128);

/// One probe in `ShaderVolume::light`.
struct PackedProbe {
    PackedSh sh{};
    /// Four channels, 1 = lit.
    glm::vec4 occlusion{1.0f};

    bool operator==(const PackedProbe&) const = default;
};

static_assert(sizeof(PackedProbe) == 128 && std::is_trivially_copyable_v<PackedProbe>);

/// One cell in `ShaderVolume::cells`. Vertices are valid indices, neighbors are valid indices or
/// kNoIndex, so that shaders need not check them.
struct ShaderCell {
    glm::uvec4 vertices{0};
    glm::uvec4 neighbors{kNoIndex};

    bool operator==(const ShaderCell&) const = default;
};

static_assert(sizeof(ShaderCell) == 32 && std::is_trivially_copyable_v<ShaderCell>);

/// The uniform block and the arrays, in the order of their bindings. No array is empty.
struct ShaderVolume {
    ShaderVolumeConstants constants;
    std::vector<glm::vec4> positions;  ///< xyz local, one per probe
    std::vector<PackedProbe> light;    ///< one per probe
    std::vector<ShaderCell> cells;
    std::vector<glm::vec4> hull_rays;  ///< xyz, three per hull cell
    std::vector<glm::uvec4> seeds;     ///< the seed grid (probes/seed_grid.h), four words each
    /// Walls between probes (probes/edge_visibility.h): the blocks, two each, then the codes of
    /// each marked cell in three words.
    std::vector<glm::uvec4> walls;

    bool operator==(const ShaderVolume&) const = default;
};

/// Texels per row if the arrays are textures. The last row is padded.
inline constexpr size_t kShaderTextureWidth = 2048;

/// Makes the arrays of a volume. The light is the light that queries read: `compact` if the volume
/// has it. The volume may be an unverified file. Cost: one copy; for a volume without a seed grid
/// also a query per probe.
[[nodiscard]] ShaderVolume make_shader_volume(const ProbeVolumeView& volume);

/// Bytes that `make_shader_volume` allocates, for the result and for temporary data.
[[nodiscard]] size_t shader_volume_memory(const ProbeVolumeView& volume);

}  // namespace tetralight
