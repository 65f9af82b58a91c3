// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Sets `volume.compact` and its scale from irradiance, occlusion and validity. The scale is the
/// smallest power of two that brings the largest coefficient to at most 2^12. Coefficients keep 11
/// bits: the error is at most 2^-11 of each, or 2^-37 of the largest one for those near zero.
/// Without irradiance there are no compact probes.
void make_compact_probes(ProbeVolume& volume);

/// The same after the light of some probes has changed. Others are written only if there are more
/// probes than before, or if the scale is too small: it grows, and never shrinks.
void update_compact_probes(ProbeVolume& volume, std::span<const uint32_t> changed);

/// The largest |coefficient| that a volume's light may have. Irradiance in any direction, which
/// adds nine of them, is finite then.
inline constexpr float kLargestCoefficient = 1e37f;

/// The largest |coefficient|, as `Layer::largest` holds it for a layer.
[[nodiscard]] float largest_coefficient(std::span<const IrradianceSh> irradiance) noexcept;

/// The smallest power of two that brings a coefficient of this size to at most 2^12.
[[nodiscard]] float compact_scale(float largest) noexcept;

/// The values of a compact probe as floats.
[[nodiscard]] IrradianceSh compact_irradiance(const CompactProbe& probe, float scale) noexcept;
[[nodiscard]] glm::vec4 compact_occlusion(const CompactProbe& probe) noexcept;

/// Number of compact probes that differ from the volume's floats by more than one step of half
/// precision. 0 if the volume has no floats. Precondition: each array holds one element a probe or
/// is empty.
[[nodiscard]] uint32_t count_wrong_compact_probes(const ProbeVolumeView& volume) noexcept;

}  // namespace tetralight
