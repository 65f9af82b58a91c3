// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// A place where a ray that leaves an enclosed space is nearest to surfaces.
struct NarrowPlace {
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f};  ///< of the ray
};

/// The holes in a surface that the rays pass: for each the smallest rectangle around the part of a
/// plane that is free. None if the places are not near to one plane, or for holes without an edge.
/// `scale`: metres per unit of the constants.
[[nodiscard]] std::vector<Opening> fit_holes(const TraceScene& trace_scene,
                                             std::span<const NarrowPlace> places, float scale);

}  // namespace tetralight
