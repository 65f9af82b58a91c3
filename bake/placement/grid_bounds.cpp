// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/grid_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/placement/candidate_count.h"
#include "bake/placement/lattice.h"
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

uint64_t most_probes(const ProbeGridSettings& settings) {
    // Where walls are thin no number of probes brings the error down to nothing.
    const uint64_t usual = settings.mode == PlacementMode::Adaptive ? 5000 : 10'000'000;
    return settings.max_probe_count.value_or(usual);
}

Result<glm::dvec3> first_spacing(const Box& bounds, const ProbeGridSettings& settings) {
    const bool is_adaptive = settings.mode == PlacementMode::Adaptive;
    constexpr double kLayers = 8.0, kWider = 1.1;
    const glm::dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    glm::dvec3 spacing = settings.spacing;
    if (is_adaptive)
        spacing = settings.adaptive.start_spacing.value_or(glm::dvec3(longest / kLayers));
    auto count = lattice_count(bounds, spacing);
    if (!count) return count.error();
    const glm::dvec3& p = bounds.low;
    if (p == bounds.high) {
        return Error{text("bounds are empty: nothing but ", p.x, ",", p.y, ",", p.z)};
    }
    const uint64_t most = most_probes(settings);
    if (settings.mode == PlacementMode::Regular) {
        // As early as can be; other modes have to look for surfaces first.
        if (auto status = check_candidate_count(*count, most); !status) return status.error();
    }
    if (!is_adaptive) return spacing;
    if (auto status = check_refined_count(most); !status) return status.error();
    // With few probes asked for it is wider; beyond reason it is a slip.
    constexpr uint64_t kAnything = 1'000'000'000;
    auto status = check_candidate_count(*count, kAnything, std::numeric_limits<uint64_t>::max());
    if (!status) return status.error();
    while (*count > static_cast<double>(std::max<uint64_t>(most / 2, 8))) {
        spacing *= kWider;
        count = lattice_count(bounds, spacing);
    }
    return spacing;
}

Result<double> checked_clearance(const glm::dvec3& spacing, const ProbeGridSettings& settings) {
    constexpr double kShare = 0.1;
    const double longest = settings.mode == PlacementMode::Adaptive ? 0.05 : 0.25;
    const double usual = std::min(kShare * std::min({spacing.x, spacing.y, spacing.z}), longest);
    const double clearance = settings.clearance.value_or(usual);
    if (clearance >= 0.0 && std::isfinite(clearance)) return clearance;
    return Error{text("clearance ", clearance, " is not a length")};
}

}  // namespace tetralight
