// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

// Another sky, a turned sky or a moved sun without another bake: volumes that were baked with
// layers "sky" and "transfer" hold how each probe answers to distant light (probes/transfer.h).

namespace tetralight {

/// Takes another sky: layer "sky" becomes what the probes' transfer makes of it, and the light of
/// the volume follows with the weights it has. A turned sky is `rotate(volume.sky[0], rotation)`.
///
/// Probes whose ringing was removed stay free of it, and none of theirs is negative: what four
/// bands make of a small bright light on the far side of a wall may be, even in the mean, and
/// becomes 0. Accurate as far as four bands hold the sky. Error: the volume holds no transfer, or
/// no layer "sky".
[[nodiscard]] Status relight_sky(ProbeVolume& volume, const DistantLight& sky);

/// Moves the sun: layer "sun" becomes what the transfer makes of a sun that shines in the unit
/// vector `direction` and gives `irradiance` to what faces it; its bounces alone when the sun is
/// `Mixed`. The light itself changes too, for whoever adds its direct term, and loses its occlusion
/// channel: what probes knew of its shadow is of the old direction.
///
/// Error: the volume holds no transfer, no layer "sun", or not exactly one sun in it.
[[nodiscard]] Status relight_sun(ProbeVolume& volume, glm::vec3 direction, glm::vec3 irradiance);

/// The light that `relight_sun` would move. Errors as there.
[[nodiscard]] Result<uint32_t> movable_sun(const ProbeVolumeView& volume);

}  // namespace tetralight
