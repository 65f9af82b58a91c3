// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>

#include <tetralight/bake/probe_estimator.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// What rounds of sampling have found at one probe so far: sums from which its light and the error
/// of that light follow. Plain data, so that a bake can be put aside and gone on with.
struct ProbeAccumulator {
    /// Σ directions · radiance, over all estimates.
    std::array<glm::dvec3, kShCoefficientCount> radiance_sum{};
    /// Σ directions² · variance of the round's mean irradiance, over rounds of two estimates and
    /// more. Variance: Σ A_l² over the 27 coefficients.
    double variance_sum = 0.0;
    uint64_t sample_count = 0;
    /// Directions that met the back of a single-sided surface first.
    uint64_t back_face_count = 0;
    uint64_t ray_count = 0;
    uint64_t round_count = 0;

    /// Adds a round of independent estimates. The order counts in the last bits of the sums.
    void add_round(std::span<const ProbeEstimate> estimates) noexcept;

    /// The mean, each direction counting the same; black before the first round.
    [[nodiscard]] RadianceSh radiance() const noexcept;

    /// Share of directions that saw a front face or the sky; 1 before the first round.
    [[nodiscard]] float validity() const noexcept;

    /// Standard error of irradiance as a share of it, root mean square over all normals and colour
    /// channels:
    ///
    ///     √( Σ_i A_l² Var(L_i) / Σ_i A_l² L_i² ),   A = π, 2π/3, π/4
    ///
    /// because the basis is orthonormal (Parseval). Var is taken from the spread of the estimates
    /// of each round. 0 where it is not known (one estimate) or there is no light.
    [[nodiscard]] float standard_error() const noexcept;

    bool operator==(const ProbeAccumulator&) const = default;
};

static_assert(sizeof(ProbeAccumulator) == 256 && std::is_trivially_copyable_v<ProbeAccumulator>);

}  // namespace tetralight
