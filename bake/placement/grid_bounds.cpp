// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/grid_bounds.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace tetralight {

Result<Box> grid_bounds(const Scene& scene, const ProbeGridSettings& settings) {
    if (settings.bounds) return *settings.bounds;
    for (const std::string& name : settings.bounds_of) {
        const bool is_there = std::ranges::any_of(
            scene.instances, [&](const MeshInstance& instance) { return instance.name == name; });
        if (!is_there) return Error{text("no node \"", name, "\" has a mesh to take bounds from")};
    }
    const auto bounds = scene_bounds(scene, [&](const MeshInstance& instance) {
        if (settings.bounds_of.empty()) return instance.contributes_gi;
        return std::ranges::find(settings.bounds_of, instance.name) != settings.bounds_of.end();
    });
    if (!bounds) return Error{"the scene has no static geometry to take bounds from"};
    return *bounds;
}

Result<double> checked_clearance(const ProbeGridSettings& settings) {
    constexpr double kShare = 0.1, kLongest = 0.25;
    const glm::dvec3& spacing = settings.spacing;
    const double usual = std::min(kShare * std::min({spacing.x, spacing.y, spacing.z}), kLongest);
    const double clearance = settings.clearance.value_or(usual);
    if (clearance >= 0.0 && std::isfinite(clearance)) return clearance;
    if (!settings.clearance) return 0.0;  // the spacing is no length, which is said elsewhere
    return Error{text("clearance ", clearance, " is not a length")};
}

}  // namespace tetralight
