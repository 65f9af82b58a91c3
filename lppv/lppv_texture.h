// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>
#include <vector>

#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/packed_sh.h>

// A proxy volume as a 3D texture of RGBA texels, which shaders sample with hardware filtering
// (runtime/shaders/lppv.glsl; this header has its C++ twin). The texture is a row of slabs along X,
// each as large as the grid:
//
//     FourSlabs    SHAr | SHAg | SHAb | occlusion
//     SevenSlabs   SHAr | SHAg | SHAb | SHBr | SHBg | SHBb | SHC
//
// The values are those of `PackedSh`, E / π. In four slabs, which are used without SHB, `w` of SHA
// is s0. In seven slabs it is s0 − s6, which shaders expect that add SHB (docs/lppv.md).

namespace tetralight {

enum class LppvLayout : uint8_t { FourSlabs, SevenSlabs };
enum class LppvTexelFormat : uint8_t { Half, Float };

/// The largest half float. Larger values are stored as this one.
inline constexpr float kLargestHalf = 65504.0f;

[[nodiscard]] constexpr uint32_t slab_count(LppvLayout layout) noexcept {
    return layout == LppvLayout::FourSlabs ? 4 : 7;
}

[[nodiscard]] constexpr size_t texel_size(LppvTexelFormat format) noexcept {
    return format == LppvTexelFormat::Half ? 8 : 16;
}

/// The texels of a proxy volume or an atlas.
struct LppvTexture {
    LppvLayout layout = LppvLayout::FourSlabs;
    LppvTexelFormat format = LppvTexelFormat::Half;
    /// Texels of all slabs together.
    glm::uvec3 size{0};
    /// RGBA, x fastest, then y. Halves saturate at ±kLargestHalf.
    std::vector<std::byte> texels;

    bool operator==(const LppvTexture&) const = default;
};

/// The texture of a proxy volume.
[[nodiscard]] LppvTexture make_lppv_texture(const Lppv& lppv, LppvLayout layout,
                                            LppvTexelFormat format);

/// The largest magnitude in the texels of such a texture, before rounding to halves.
[[nodiscard]] float largest_texel_value(const Lppv& lppv, LppvLayout layout);

/// The shader constants of a texture, in std140 layout. The first four are Unity's
/// unity_ProbeVolumeWorldToObject, unity_ProbeVolumeParams, unity_ProbeVolumeMin and
/// unity_ProbeVolumeSizeInv. The last two include half a texel, so that a grid point maps to the
/// center of its texel.
struct LppvConstants {
    glm::mat4 local_from_world{1.0f};
    /// Enabled (1), local space (1) or world space (0), width of a texel, 0.
    glm::vec4 params{0.0f};
    glm::vec4 low{0.0f};
    /// 0 along an axis of one point or without thickness.
    glm::vec4 size_inverse{0.0f};
    /// For four slabs: the mean of band 2 over the grid.
    glm::vec4 shb_r{0.0f}, shb_g{0.0f}, shb_b{0.0f}, shc{0.0f};

    bool operator==(const LppvConstants&) const = default;
};

static_assert(sizeof(LppvConstants) == 176 && std::is_trivially_copyable_v<LppvConstants>);

/// The constants of the texture of a proxy volume.
[[nodiscard]] LppvConstants make_lppv_constants(const Lppv& lppv, LppvLayout layout);

/// The light at a world position, for `sample_sh9`. Its band 2 comes from the constants for four
/// slabs (0 in quality `Low`) and from the texture for seven. The twin of the shader's functions.
[[nodiscard]] PackedSh sample_lppv_texture(const LppvTexture& texture,
                                           const LppvConstants& constants,
                                           glm::vec3 position) noexcept;

/// Occlusion at a world position: the last of four slabs; (1, 1, 1, 1) for seven.
[[nodiscard]] glm::vec4 sample_lppv_occlusion(const LppvTexture& texture,
                                              const LppvConstants& constants,
                                              glm::vec3 position) noexcept;

/// One texel, and the texture at coordinates from 0 to 1 with the linear filter of hardware,
/// clamped at the edges. Precondition: the texture has texels.
[[nodiscard]] glm::vec4 fetch_texel(const LppvTexture& texture, glm::uvec3 texel) noexcept;
[[nodiscard]] glm::vec4 filter_texture(const LppvTexture& texture, glm::vec3 uvw) noexcept;

}  // namespace tetralight
