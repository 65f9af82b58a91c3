// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// Limits of the virtual offset of a probe inside geometry.
struct VirtualOffsetSettings {
    /// Maximum length of the offset, metres.
    float max_distance = 0.0f;
    /// Distance in front of the surface, metres. If another surface is nearer than twice the
    /// margin, the offset ends half way to it.
    float margin = 0.0f;
    /// See `ProbeVisibility::is_inside`.
    float min_validity = 0.75f;
};

/// The virtual offset of a position in render space: to the front side of the nearest surface that
/// is hit from behind, towards the closest point of the scene or along one of
/// `probe_visibility_directions`, provided that the position there is not inside geometry. None if
/// no such position lies within the maximum distance. Pure.
[[nodiscard]] std::optional<glm::vec3> find_virtual_offset(const TraceScene& trace_scene,
                                                           glm::vec3 position,
                                                           const VirtualOffsetSettings& settings);

}  // namespace tetralight
