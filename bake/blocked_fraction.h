// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// The fraction of the way from one position to another, in render space, at which surfaces have
/// stopped half of the light or more, whichever side they show. None: at least half arrives.
/// Surfaces nearer than a ten-thousandth of the way are not seen: a probe on a wall sees both
/// sides. Pure.
[[nodiscard]] std::optional<float> blocked_fraction(const TraceScene& trace_scene, glm::vec3 from,
                                                    glm::vec3 to);

/// The same of the mean over a pencil of five rays from `from` to places around `to`, at most a
/// hundredth of the way apart: holes and stems that are smaller decide by their share. For a plane
/// it is the fraction at which the middle ray meets it.
[[nodiscard]] std::optional<float> blocked_fraction_of_pencil(const TraceScene& trace_scene,
                                                              glm::vec3 from, glm::vec3 to);

}  // namespace tetralight
