// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Where to place reflection probes.
struct ReflectionRule {
    WorldBox bounds;
    /// Metres between probes outdoors; above 0.
    double spacing = 10.0;
    /// Positions that are nearer to surfaces are not free, metres; above 0.
    double clearance = 0.2;
    /// No probe is where they forbid probes.
    std::span<const ProbeAdjustment> adjustments;
    /// Returns true in the spaces to fill. Empty: everywhere.
    std::function<bool(const glm::dvec3& position)> is_filled;
    uint32_t thread_count = 0;
};

/// Reflection probes for a scene: one in each room (`find_rooms`) that has a ceiling and three more
/// sides, with its box at the walls, and importance 2; and outdoors one in each square of at most
/// `spacing`, 2 m above the ground, with importance 1 and boxes that overlap by the blend distance.
/// Each is at the free position that is nearest to the middle of its box. The blend distance is a
/// tenth of the box's smallest side. A room inside the box of a larger one has no probe, and
/// neither has one that is less than 0.8 m wide; an arcade around an open court has up to eight.
/// Deterministic.
[[nodiscard]] std::vector<ReflectionPlace> place_reflections(const TraceScene& traced,
                                                             const ReflectionRule& rule);

}  // namespace tetralight
