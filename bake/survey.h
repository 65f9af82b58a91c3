// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/scene/scene.h"
#include "base/result.h"

namespace tetralight {

/// What surrounds a position, over a fixed set of directions.
struct Surroundings {
    /// Share of rays that meet the back of a single-sided surface.
    float back_face_share = 0.0f;
    /// Share of rays that meet any surface from behind.
    float behind_share = 0.0f;

    /// Whether the position lies inside geometry. Few back faces of single-sided surfaces are
    /// enough, as nobody is meant to see them; those of double-sided ones must nearly surround it.
    [[nodiscard]] bool is_inside() const { return back_face_share > 0.25f || behind_share > 0.75f; }
};

/// Looks around from each world position. Deterministic. Error: not enough memory.
[[nodiscard]] Result<std::vector<Surroundings>> survey(const Scene& scene,
                                                       std::span<const glm::dvec3> positions,
                                                       uint32_t thread_count = 0);

}  // namespace tetralight
