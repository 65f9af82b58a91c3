// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/length_unit.h>

#include <algorithm>
#include <cstdint>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {

std::string length_unit_hint(const Scene& scene) {
    constexpr double kLarge = 500.0;  // metres
    const auto bounds = scene_bounds(scene, [](const MeshInstance&) { return true; });
    if (!bounds) return "";
    const glm::dvec3 size = bounds->max - bounds->min;
    const double widest = std::max({size.x, size.y, size.z});
    if (widest < kLarge || widest > 1e15) return "";
    return str_cat("the scene is ", static_cast<int64_t>(widest),
                   " m wide; if its unit is a centimetre, scale it by 0.01");
}

}  // namespace tetralight
