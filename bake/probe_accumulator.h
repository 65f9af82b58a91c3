// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>

#include <tetralight/bake/cut_light.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/round_variance.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// The sums of all rounds of samples at one probe or texel, from which its radiance and the error
/// of it follow. Plain data, so that a bake can be stored and continued. All calls for one
/// accumulator have the same `measure`.
struct ProbeAccumulator {
    /// Σ samples · radiance, over all estimates. Of texels: in the frame of the normal
    /// (`estimate_texel`), with the light of one half in place of band 2 (`keep_half`).
    RadianceSums radiance_sum{};
    /// Σ samples² · variance of the mean irradiance of a round, over rounds of two or more
    /// estimates, by `irradiance_square`.
    double variance_sum = 0.0;
    uint64_t sample_count = 0;
    /// Samples whose first hit is the back face of a single-sided surface.
    uint64_t back_face_count = 0;
    uint64_t ray_count = 0;
    uint64_t round_count = 0;
    /// Of the light of paths that the limit of bounces cuts.
    CutLight cut;

    /// Adds a round of independent estimates. Their order affects the last bits of the sums.
    void add_round(std::span<const ProbeEstimate> estimates,
                   ErrorMeasure measure = ErrorMeasure::AllNormals);

    /// The mean over all samples; black before the first round.
    [[nodiscard]] RadianceSh radiance() const noexcept;

    /// Fraction of samples that hit a front face or the sky; 1 before the first round.
    [[nodiscard]] float validity() const noexcept;

    /// Relative standard error of the irradiance, root mean square over colour channels and, for
    /// probes, over all normals. By Parseval's theorem, as the basis is orthonormal:
    ///
    ///     √( Σ_i A_l² Var(L_i) / Σ_i A_l² L_i² ),   A = π, 2π/3, π/4
    ///
    /// Var follows from the spread of the estimates in each round. 0 if it is unknown (one
    /// estimate) or no light arrives. Light that no sample has hit is not accounted for. More
    /// samples reduce it.
    [[nodiscard]] float sampling_error(
        ErrorMeasure measure = ErrorMeasure::AllNormals) const noexcept;

    /// `sampling_error` and the light that the limit of bounces loses: the root mean square
    /// difference to the light of paths of any length. The lost light D (`CutLight`) is taken to
    /// arrive evenly from all directions:
    ///
    ///     √( sampling_error² + π² D² / Σ_i A_l² L_i² )
    ///
    /// The squares add because the error of an estimate of variance V and bias D has the mean
    /// square V + D². 0 if the sampling error is. For texels: π² D² becomes (π Y_0 D)², and the sum
    /// the square of the irradiance.
    [[nodiscard]] float standard_error(
        ErrorMeasure measure = ErrorMeasure::AllNormals) const noexcept;

    bool operator==(const ProbeAccumulator&) const = default;
};

static_assert(sizeof(ProbeAccumulator) == 296 && std::is_trivially_copyable_v<ProbeAccumulator>);

}  // namespace tetralight
