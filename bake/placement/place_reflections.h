// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/placement/reflection_rule.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/reflection_place.h>

namespace tetralight {

/// Reflection probes for a scene. One is in each room (`find_rooms`) that has a ceiling and three
/// more sides, with its box at the walls, and importance 2. Outdoors one is in each square of at
/// most `spacing`, 2 m above the ground if there is any, with importance 1. Each is at the free
/// position that is nearest to the middle of its box. The blend distance is a tenth of the box's
/// smallest side; in rooms less than 2.5 times as far from another one, the distance to it, so that
/// they blend in doorways and not behind walls. A room inside the box of a larger one has no probe,
/// and neither has one that is less than 0.8 m wide; an arcade around an open court has up to
/// eight. Deterministic.
[[nodiscard]] std::vector<ReflectionPlace> place_reflections(const TraceScene& traced,
                                                             const ReflectionRule& rule);

}  // namespace tetralight
