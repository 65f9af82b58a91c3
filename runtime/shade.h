// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/light.h>
#include <tetralight/probes/packed_sh.h>

namespace tetralight {

/// Irradiance / π that one unshadowed light adds to a surface: the direct term of a light that is
/// not `Baked`.
[[nodiscard]] glm::vec3 direct_light(const Light& light, glm::vec3 position,
                                     glm::vec3 normal) noexcept;
/// The same of light whose arrival is known.
[[nodiscard]] glm::vec3 direct_light(const Illumination& arriving, glm::vec3 normal) noexcept;

/// Exitant radiance of a Lambert surface under probe light and `direct` (a sum of `direct_light`,
/// each times its visibility): albedo · (max(0, E(n)/π) + direct).
[[nodiscard]] glm::vec3 shade_diffuse(glm::vec3 albedo, const PackedSh& probe_light,
                                      glm::vec3 normal, glm::vec3 direct) noexcept;

}  // namespace tetralight
