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

/// Exitant radiance of a Lambert surface under probe light and `direct` (a sum of `direct_light`,
/// each times its visibility): albedo · (max(0, E(n)/π) + direct).
[[nodiscard]] glm::vec3 shade_diffuse(glm::vec3 albedo, const PackedSh& probe_light,
                                      glm::vec3 normal, glm::vec3 direct) noexcept;

}  // namespace tetralight
