// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>
#include <tetralight/probes/packed_sh.h>

namespace tetralight {

/// Irradiance / π of one unshadowed light on a surface: the direct term of a light that is not
/// `Baked`.
[[nodiscard]] glm::vec3 direct_light(const Light& light, glm::vec3 position,
                                     glm::vec3 normal) noexcept;
/// The same for light whose direction and irradiance are known.
[[nodiscard]] glm::vec3 direct_light(const Illumination& arriving, glm::vec3 normal) noexcept;

/// Baked light with the real-time shadow of a light that is in it (`MixedLighting::Subtractive`):
/// without the light's direct term where a moving object blocks it, but no darker than
/// `shadow_color`, which keeps shadows that are baked already from being subtracted twice. All are
/// irradiance / π. `lit`: the fraction of the light that passes the moving objects.
[[nodiscard]] glm::vec3 subtract_shadow(glm::vec3 baked, glm::vec3 direct, float lit,
                                        glm::vec3 shadow_color) noexcept;

/// Exitant radiance of a Lambert surface under probe light and `direct` (a sum of `direct_light`,
/// each times its visibility): albedo · (max(0, E(n)/π) + direct).
[[nodiscard]] glm::vec3 shade_diffuse(glm::vec3 albedo, const PackedSh& probe_light,
                                      glm::vec3 normal, glm::vec3 direct) noexcept;

}  // namespace tetralight
