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
// (runtime/shaders/lppv.glsl; its twin in C++ is here). The texture is a row of slabs along X, each
// as large as the grid:
//
//     FourSlabs    SHAr | SHAg | SHAb | occlusion
//     SevenSlabs   SHAr | SHAg | SHAb | SHBr | SHBg | SHBb | SHC
//
// Values are those of `PackedSh`, E / π. Four slabs have s0 as `w` of SHA, so that they are right
// by themselves; seven have s0 − s6 there, as shaders expect that add SHB (docs/lppv.md says more).

namespace tetralight {

enum class LppvLayout : uint8_t { FourSlabs, SevenSlabs };
enum class LppvTexelFormat : uint8_t { Half, Float };

/// The largest half; what is beyond it is stored as it.
inline constexpr float kLargestHalf = 65504.0f;

[[nodiscard]] constexpr uint32_t slab_count(LppvLayout layout) noexcept {
    return layout == LppvLayout::FourSlabs ? 4 : 7;
}

[[nodiscard]] constexpr size_t texel_size(LppvTexelFormat format) noexcept {
    return format == LppvTexelFormat::Half ? 8 : 16;
}

struct LppvTexture {
    LppvLayout layout = LppvLayout::FourSlabs;
    LppvTexelFormat format = LppvTexelFormat::Half;
    /// Texels, all slabs together.
    glm::uvec3 size{0};
    /// RGBA, x fastest, then y. Halves saturate at ±kLargestHalf.
    std::vector<std::byte> texels;

    bool operator==(const LppvTexture&) const = default;
};

[[nodiscard]] LppvTexture make_lppv_texture(const Lppv& lppv, LppvLayout layout,
                                            LppvTexelFormat format);

/// The largest magnitude among the texels of such a texture, as floats.
[[nodiscard]] float largest_texel_value(const Lppv& lppv, LppvLayout layout);

/// What a shader needs beside the texture, as std140 has it. The first four are Unity's
/// unity_ProbeVolumeWorldToObject, unity_ProbeVolumeParams, unity_ProbeVolumeMin and
/// unity_ProbeVolumeSizeInv; half a texel is folded into the last two, so that a coordinate on a
/// grid point is the middle of its texel.
struct LppvConstants {
    glm::mat4 local_from_world{1.0f};
    /// Enabled (1), in local space (1) or the world's (0), width of a texel, 0.
    glm::vec4 params{0.0f};
    glm::vec4 low{0.0f};
    /// 0 along an axis of one point or no thickness.
    glm::vec4 size_inverse{0.0f};
    /// For four slabs: band 2 of the whole object, its mean over the grid.
    glm::vec4 shb_r{0.0f}, shb_g{0.0f}, shb_b{0.0f}, shc{0.0f};

    bool operator==(const LppvConstants&) const = default;
};

static_assert(sizeof(LppvConstants) == 176 && std::is_trivially_copyable_v<LppvConstants>);

[[nodiscard]] LppvConstants make_lppv_constants(const Lppv& lppv, LppvLayout layout);

/// What the shader's functions return for a world position: light for `sample_sh9`, band 2
/// included. For four slabs without band 2 (quality `Low`) it has none.
[[nodiscard]] PackedSh sample_lppv_texture(const LppvTexture& texture,
                                           const LppvConstants& constants,
                                           glm::vec3 position) noexcept;

/// Occlusion at a world position: the last of four slabs; seven have none, (1, 1, 1, 1).
[[nodiscard]] glm::vec4 sample_lppv_occlusion(const LppvTexture& texture,
                                              const LppvConstants& constants,
                                              glm::vec3 position) noexcept;

/// A texel, and the texture between texels as hardware filters it: linear, edges clamped. Texture
/// coordinates from 0 to 1. Precondition: the texture has texels.
[[nodiscard]] glm::vec4 fetch_texel(const LppvTexture& texture, glm::uvec3 texel) noexcept;
[[nodiscard]] glm::vec4 filter_texture(const LppvTexture& texture, glm::vec3 uvw) noexcept;

}  // namespace tetralight
