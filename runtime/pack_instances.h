// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/interpolate.h>

// Probe light in the layouts of instancing renderers: for N instances either seven arrays of
// float4, one for each shader variable (as Unity's
// MaterialPropertyBlock.CopySHCoefficientArraysFrom fills them), or seven consecutive float4 per
// instance, for example inside an instance buffer.
//
//     std::vector<uint32_t> cells(count, kNoIndex);  // kept from frame to frame
//     pack_instances(volume, {.positions = positions, .hints = cells,
//                             .arrays = {shar, shag, shab, shbr, shbg, shbb, shc},
//                             .occlusion = occlusion});

namespace tetralight {

/// One array for each float4 of `PackedSh`, with one element per instance.
struct PackedShArrays {
    std::span<glm::vec4> sha_r = {}, sha_g = {},
                         sha_b = {};  ///< unity_SHAr, unity_SHAg, unity_SHAb
    std::span<glm::vec4> shb_r = {}, shb_g = {},
                         shb_b = {};  ///< unity_SHBr, unity_SHBg, unity_SHBb
    std::span<glm::vec4> shc = {};    ///< unity_SHC

    /// True if all spans are empty.
    [[nodiscard]] bool empty() const noexcept;
};

/// Many instances, and the output for their light: `arrays` or `packed`.
struct InstanceBatch {
    /// World space, one per instance.
    std::span<const glm::vec3> positions;
    /// In: the cell where each walk starts. Out: the cell found, for the next frame. May be empty.
    std::span<uint32_t> hints = {};
    /// All seven spans or none.
    PackedShArrays arrays = {};
    /// One `PackedSh` per instance: a container of them, or `strided(bytes, ShFormat::Packed,
    /// stride)` for those inside an instance buffer.
    ShOutput packed = {};
    /// Four channels per instance, 1 = lit: a container of float4 (unity_ProbesOcclusion), or
    /// `strided_occlusion`.
    OcclusionOutput occlusion = {};
    OutsideHull outside = {};
    Walls walls = Walls::HideProbes;
    /// As in `InterpolationBatch`.
    std::span<const uint32_t> rendering_layers = {};
    std::span<const float> radii = {};
};

/// Locates every instance, blends its probes and writes irradiance / π as `pack_sh` does. Returns
/// invalid_argument if both `arrays` and `packed` are given or `packed` has another format, and the
/// errors of `interpolate`. Thread-safe on one volume; does not allocate.
[[nodiscard]] Result<BatchReport> pack_instances(const ProbeVolumeView& volume,
                                                 const InstanceBatch& batch);

}  // namespace tetralight
