// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// How a probe that lies in geometry finds a place to gather light from.
struct VirtualOffsetSettings {
    /// No offset is longer than this, metres.
    float max_distance = 0.0f;
    /// How far beyond the surface the place should lie, metres; less where there is less room.
    float margin = 0.0f;
    /// See `ProbeVisibility::is_inside`.
    float min_validity = 0.75f;
};

/// The way out of geometry from a position in render space: through the nearest back face, seen
/// towards the nearest surface or in a direction of the survey, beyond which lies a place that is
/// not inside. None: there is no such place in reach. Pure.
[[nodiscard]] std::optional<glm::vec3> find_virtual_offset(const TraceScene& trace_scene,
                                                           glm::vec3 position,
                                                           const VirtualOffsetSettings& settings);

}  // namespace tetralight
