// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/placement/reflection_rule.h>
#include <tetralight/bake/placement/rooms.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {

/// Reflection probes for the open points of a map that are in none of the boxes of rooms, as
/// `place_reflections` describes them: square by square, those of the lowest z first.
[[nodiscard]] std::vector<ReflectionPlace> place_outdoors(const TraceScene& traced,
                                                          const ReflectionRule& rule,
                                                          const RoomMap& map,
                                                          std::span<const WorldBox> rooms);

}  // namespace tetralight
