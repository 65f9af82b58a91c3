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

/// What surrounds a position: over a fixed set of directions, the same for all.
struct ProbeVisibility {
    /// Share of rays that meet the back of a single-sided surface.
    float back_face_fraction = 0.0f;
    /// Share of rays that meet any surface from behind.
    float behind_fraction = 0.0f;
    /// Share of rays that meet nothing.
    float escape_fraction = 0.0f;
    /// Metres to the nearest point of any surface; infinite: there is none.
    float surface_distance = std::numeric_limits<float>::infinity();

    /// Whether the position lies inside geometry. Few back faces of single-sided surfaces are
    /// enough, as nobody is meant to see them; those of double-sided ones must nearly surround it.
    [[nodiscard]] bool is_inside(float min_validity = 0.75f) const {
        return back_face_fraction > 1.0f - min_validity || behind_fraction > 0.75f;
    }
};

/// Looks around from a position in render space. Pure.
[[nodiscard]] ProbeVisibility probe_visibility(const TraceScene& trace_scene, glm::vec3 position);

/// Looks around from each world position. Deterministic. Error: not enough memory.
[[nodiscard]] Result<std::vector<ProbeVisibility>> probe_visibilities(
    const Scene& scene, std::span<const glm::dvec3> positions, uint32_t thread_count = 0);

/// The directions that a survey looks in.
[[nodiscard]] std::span<const glm::vec3> probe_visibility_directions();

}  // namespace tetralight
