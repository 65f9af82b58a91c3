// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace tetralight {

/// What tells how much light a limit of bounces loses: sums over samples, all of them 0 if no path
/// reaches the limit.
struct CutLight {
    /// Σ samples · coefficient 0 of the radiance that arrives after as many reflections as the
    /// limit allows.
    glm::dvec3 last_radiance{0.0};
    /// Σ throughput of paths on the segment after their last reflection, and at its end after the
    /// surface that it hits, where they are cut.
    double last_throughput = 0.0;
    double cut_throughput = 0.0;

    void add(const CutLight& other) noexcept;

    /// Estimates Σ samples · coefficient 0 of the radiance of all longer paths.
    ///
    /// Each further reflection multiplies the throughput by about the same ratio q, that of the
    /// last segment: cut over last throughput, the share of the light that neither escapes nor is
    /// absorbed. The light of n further reflections is then q^n of the last, and all of it together
    /// q / (1 − q). In a closed room of constant albedo and emission (a furnace) q is the albedo
    /// and the estimate is exact. Elsewhere it is an estimate: the ratio of the light itself tends
    /// to the same q, as both are powers of one transport operator, but has more noise. q is at
    /// most 0.999, so that the estimate is finite.
    [[nodiscard]] glm::dvec3 lost_radiance() const noexcept;

    bool operator==(const CutLight&) const = default;
};

static_assert(sizeof(CutLight) == 40);

}  // namespace tetralight
