// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

// Changes or rotates the sky, or moves the sun, without another bake: volumes that were baked with
// layers "sky" and "transfer" hold the transfer of each probe from distant light
// (probes/transfer.h). Metadata does not change: programs that write such a volume record in member
// "relit" of its JSON object that the light is not that of the scene.

namespace tetralight {

/// Replaces the sky: layer "sky" becomes the probes' transfer of the new sky, and the light of the
/// volume is recombined with its current weights. A rotated sky is `rotate(volume.sky[0],
/// rotation)`.
///
/// Probes whose ringing was removed stay free of it and have no negative irradiance: a mean that
/// four bands make negative, as of a small bright light behind a wall, becomes 0. The result is as
/// accurate as four bands represent the sky. Returns invalid_argument if the volume holds no
/// transfer, and not_found if it has no layer "sky".
[[nodiscard]] Status relight_sky(ProbeVolume& volume, const DistantLight& sky);

/// Moves the sun: layer "sun" becomes the transfer of a sun that shines along the unit vector
/// `direction` with `irradiance` on a surface that faces it; only its bounces if the sun is
/// `Mixed`. The light in `volume.lights` changes too, so that a runtime adds the new direct term.
/// It loses its occlusion channel, because the stored occlusion is that of the old direction.
///
/// Returns invalid_argument if the volume holds no transfer or not exactly one sun in layer "sun",
/// and not_found if it has no such layer.
[[nodiscard]] Status relight_sun(ProbeVolume& volume, glm::vec3 direction, glm::vec3 irradiance);

/// The light that `relight_sun` would move. Returns the same errors.
[[nodiscard]] Result<uint32_t> movable_sun(const ProbeVolumeView& volume);

}  // namespace tetralight
