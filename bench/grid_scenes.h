// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// The name of the scene of the options.
inline constexpr const char* kExternalScene = "scene";

/// A scene to fill with probes.
struct GridSubject {
    std::string name;
    Scene scene;
    WorldBox bounds;
    /// Positions in the spaces to fill (`ProbeGridSettings::from`). Empty: the largest space.
    std::vector<glm::dvec3> from;

    [[nodiscard]] bool is_external() const { return name == kExternalScene; }
};

/// The courtyard, a house, two rooms, a furnished interior, and last the scene of the options.
///
/// The house has two storeys of 12 × 8 m with six rooms each. Its walls, slabs and furniture are
/// closed boxes that touch and intersect. Doors join the rooms, a stairwell the storeys; windows
/// let in sun and sky, and every other room has a point light. The rooms are `two_rooms` with a
/// wall of 20 cm and a seed in each, the interior is `furnished_interior`.
[[nodiscard]] std::vector<GridSubject> grid_subjects(const Options& options);

}  // namespace tetralight::bench
