// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Distance of reflection probes from surfaces, metres, where there is room for it.
inline constexpr double kFarFromSurfaces = 0.5;

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

    [[nodiscard]] bool fills(const glm::dvec3& position) const {
        return !is_filled || is_filled(position);
    }
};

/// True if a probe may be at a position: it is free, and no adjustment volume forbids it.
[[nodiscard]] bool allows_reflection_probe(const TraceScene& traced, const ReflectionRule& rule,
                                           const glm::dvec3& position, double clearance);

/// A place in its box. The blend distance is a tenth of the box's smallest side.
[[nodiscard]] ReflectionPlace make_reflection_place(const glm::dvec3& position, const WorldBox& box,
                                                    int importance);

}  // namespace tetralight
