// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/interpolate.h>

// Probe light as instancing renderers upload it: for N instances either seven arrays of float4, one
// for each shader variable (what Unity's MaterialPropertyBlock.CopySHCoefficientArraysFrom fills),
// or the seven float4 of each instance in one piece, inside an instance buffer for example.
//
//     std::vector<uint32_t> cells(count, kNoIndex);  // kept from frame to frame
//     pack_instances(volume, {.positions = positions, .hints = cells,
//                             .arrays = {shar, shag, shab, shbr, shbg, shbb, shc},
//                             .occlusion = occlusion});

namespace tetralight {

/// The float4 of `PackedSh` in an array each, one element an instance.
struct PackedShArrays {
    std::span<glm::vec4> sha_r = {}, sha_g = {},
                         sha_b = {};  ///< unity_SHAr, unity_SHAg, unity_SHAb
    std::span<glm::vec4> shb_r = {}, shb_g = {},
                         shb_b = {};  ///< unity_SHBr, unity_SHBg, unity_SHBb
    std::span<glm::vec4> shc = {};    ///< unity_SHC

    /// Whether none of them is there.
    [[nodiscard]] bool empty() const noexcept;
};

/// Many instances, and where their light goes: to `arrays` or to `packed`.
struct InstanceBatch {
    /// World space, one an instance.
    std::span<const glm::vec3> positions;
    /// In: where each walk starts; out: the cell found, for the next frame. May be empty.
    std::span<uint32_t> hints = {};
    /// All seven or none.
    PackedShArrays arrays = {};
    /// One `PackedSh` an instance: a container of them, or `strided(bytes, ShFormat::Packed,
    /// stride)` for those inside an instance buffer.
    ShOutput packed = {};
    /// Four channels an instance, 1 = lit: a container of float4 (unity_ProbesOcclusion), or
    /// `strided_occlusion`.
    OcclusionOutput occlusion = {};
    OutsideHull outside = {};
};

/// Locates every instance, blends its probes and writes irradiance / π as `pack_sh` does. Errors:
/// `arrays` and `packed` both, `packed` of another format, and those of `interpolate`. Thread-safe
/// on one volume; allocates nothing.
[[nodiscard]] Result<BatchReport> pack_instances(const ProbeVolumeView& volume,
                                                 const InstanceBatch& batch);

}  // namespace tetralight
