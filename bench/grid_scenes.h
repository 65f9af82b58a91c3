// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bake/scene/scene.h"
#include "bake/scene/scene_bounds.h"
#include "bench/harness.h"

namespace tetralight::bench {

/// A house of two storeys with six rooms each, 12 × 8 m: walls, slabs and furniture are closed
/// boxes that meet and cross. Doors join the rooms, a stairwell the storeys; windows let in sun and
/// sky, and every other room has a lamp.
struct House {
    Scene scene;
    /// All its solids: a position is inside geometry when one of them holds it.
    std::vector<Box> solids;

    /// Faces are at floats: a position is inside when it is `depth` metres from them or more.
    [[nodiscard]] bool is_inside(const glm::dvec3& position, double depth = 0.0) const;
};

[[nodiscard]] House make_house();

/// A scene to fill with probes.
struct GridSubject {
    std::string name;
    Scene scene;
    Box bounds;
};

/// The courtyard, the house, and the scene of the options.
[[nodiscard]] std::vector<GridSubject> grid_subjects(const Options& options);

}  // namespace tetralight::bench
