// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// What rays from a position hit, over a fixed set of directions that is the same for all
/// positions.
struct ProbeVisibility {
    /// Fraction of rays that hit the back face of a single-sided surface.
    float back_face_fraction = 0.0f;
    /// Fraction of rays that hit any surface, double-sided ones included, from behind.
    float behind_fraction = 0.0f;
    /// Fraction of rays that hit no surface.
    float escape_fraction = 0.0f;
    /// Distance to the nearest surface, metres; infinite if the scene has none.
    float surface_distance = std::numeric_limits<float>::infinity();

    /// True if the position lies inside geometry: more than 1 − `min_validity` of the rays hit back
    /// faces of single-sided surfaces, or more than 75 % hit any surface from behind. The limit for
    /// double-sided surfaces is higher because their backs are visible from free space too.
    [[nodiscard]] bool is_inside(float min_validity = 0.75f) const {
        return back_face_fraction > 1.0f - min_validity || behind_fraction > 0.75f;
    }
};

/// The visibility from one position in render space. Pure.
[[nodiscard]] ProbeVisibility probe_visibility(const TraceScene& trace_scene, glm::vec3 position);

/// The visibility from each world position, for static geometry. Deterministic. Returns the errors
/// of `TraceScene::make_static`.
[[nodiscard]] Result<std::vector<ProbeVisibility>> probe_visibilities(
    const Scene& scene, std::span<const glm::dvec3> positions, uint32_t thread_count = 0);

/// The directions of the rays.
[[nodiscard]] std::span<const glm::vec3> probe_visibility_directions();

}  // namespace tetralight
