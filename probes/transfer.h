// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <type_traits>

#include <tetralight/probes/distant_light.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// Transfer of one probe: a matrix from the coefficients of distant radiance to those of its
/// irradiance (precomputed radiance transfer: Sloan, Kautz & Snyder 2002).
/// Direct and reflected light are separate, because probes hold only the reflected light of `Mixed`
/// suns.
struct ProbeTransfer {
    template <class T>
    using Matrix = std::array<std::array<T, kDistantCoefficientCount>, kShCoefficientCount>;

    /// Direct light: one matrix for all colours.
    Matrix<float> direct{};
    Matrix<glm::vec3> bounced{};

    bool operator==(const ProbeTransfer&) const = default;
};

static_assert(sizeof(ProbeTransfer) == 2304 && std::is_trivially_copyable_v<ProbeTransfer>);

/// Irradiance at a probe under a distant light: E_i = Σ_j (direct + bounced)_ij L_j.
[[nodiscard]] IrradianceSh transfer_light(const ProbeTransfer& probe,
                                          const DistantLight& light) noexcept;

/// The part that arrives straight away.
[[nodiscard]] IrradianceSh transfer_direct(const ProbeTransfer& probe,
                                           const DistantLight& light) noexcept;

/// The part that surfaces reflected, for a sun whose direct term the runtime adds.
[[nodiscard]] IrradianceSh transfer_bounces(const ProbeTransfer& probe,
                                            const DistantLight& light) noexcept;

}  // namespace tetralight
