// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/grid_bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/bake/placement/lattice.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {

namespace {

constexpr int kUp = 1;

/// True if an instance is a node of this name, or below one.
bool is_part_of(const Scene& scene, const MeshInstance& instance, const std::string& name) {
    if (instance.name == name) return true;
    for (uint32_t node = instance.node; node != kNoIndex; node = scene.nodes[node].parent) {
        if (scene.nodes[node].name == name) return true;
    }
    return false;
}

Status check_name(const Scene& scene, const std::string& name) {
    const auto is_part = [&](const MeshInstance& i) { return is_part_of(scene, i, name); };
    if (std::ranges::any_of(scene.instances, is_part)) return Ok{};
    const bool has_node = std::ranges::count(scene.nodes, name, &SceneNode::name) > 0;
    if (has_node) {
        return Error{ErrorCode::InvalidArgument, "bounds_of", name,
                     str_cat("node \"", name, "\" has no mesh to take bounds from")};
    }
    return Error{ErrorCode::NotFound, "bounds_of", name,
                 str_cat("there is no node \"", name, "\"")};
}

double tenth_of(const glm::dvec3& spacing) {
    return 0.1 * std::min({spacing.x, spacing.y, spacing.z});
}

Result<double> checked_length(const char* name, double length) {
    if (length >= 0.0 && std::isfinite(length)) return length;
    return Error{ErrorCode::InvalidArgument, name, str_cat(length),
                 str_cat(name, " ", length, " is not a length")};
}

}  // namespace

Result<WorldBox> grid_bounds(const Scene& scene, const ProbeGridSettings& settings) {
    if (settings.bounds) return *settings.bounds;
    for (const std::string& name : settings.bounds_of) {
        if (auto status = check_name(scene, name); !status) return status.error();
    }
    const auto bounds = scene_bounds(scene, [&](const MeshInstance& instance) {
        if (settings.bounds_of.empty()) return instance.contributes_gi;
        return std::ranges::any_of(settings.bounds_of, [&](const std::string& name) {
            return is_part_of(scene, instance, name);
        });
    });
    if (!bounds) {
        return Error{ErrorCode::InvalidArgument, "bounds", "",
                     "the scene has no static geometry to take bounds from"};
    }
    return *bounds;
}

WorldBox padded_bounds(const WorldBox& bounds, const glm::dvec3& spacing, double clearance,
                       const ProbeGridSettings& settings) {
    if (settings.bounds) return bounds;
    WorldBox box = bounds;
    const glm::dvec3 size = bounds.size();
    const double flat = settings.mode == PlacementMode::Adaptive ? 0.125 : 0.25;
    const double least = flat * std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        const double missing = std::min(2.0 * spacing[axis], least) - size[axis];
        if (missing <= 0.0) continue;
        if (axis != kUp) box.min[axis] -= 0.5 * missing;
        box.max[axis] += axis == kUp ? missing : 0.5 * missing;
    }
    if (settings.mode == PlacementMode::Layers && !settings.heights.empty()) {
        box.max[kUp] += std::ranges::max(settings.heights);
    }
    if (settings.mode == PlacementMode::Surface) {
        box.min -= glm::dvec3(clearance, 0.0, clearance);
        box.max += glm::dvec3(clearance);
    }
    return box;
}

bool is_in(const WorldBox& box, const glm::dvec3& position) {
    constexpr double kRounding = 1e-6;
    const glm::dvec3 slack = kRounding * glm::max(glm::dvec3(1.0), box.size());
    return contains(WorldBox{box.min - slack, box.max + slack}, position);
}

uint64_t probe_limit(const ProbeGridSettings& settings) {
    // With thin walls, no number of probes removes the error.
    const uint64_t usual = settings.mode == PlacementMode::Adaptive ? 5000 : 10'000'000;
    return settings.max_probes.value_or(usual);
}

Result<glm::dvec3> candidate_spacing(const WorldBox& bounds, const ProbeGridSettings& settings) {
    const bool is_adaptive = settings.mode == PlacementMode::Adaptive;
    constexpr double kLayers = 8.0, kWider = 1.1;
    const glm::dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    glm::dvec3 spacing = settings.spacing;
    if (is_adaptive)
        spacing = settings.adaptive.start_spacing.value_or(glm::dvec3(longest / kLayers));
    auto count = lattice_count(bounds, spacing);
    if (!count) return count.error();
    const glm::dvec3& p = bounds.min;
    if (p == bounds.max) {
        const std::string value = str_cat(p.x, ",", p.y, ",", p.z);
        return Error{ErrorCode::InvalidArgument, "bounds", value,
                     str_cat("bounds are empty: nothing but ", value)};
    }
    const uint64_t max_count = probe_limit(settings);
    if (settings.mode == PlacementMode::Regular) {
        // Checked as early as possible; other modes have to find surfaces first.
        if (auto status = check_candidate_count(*count, max_count); !status) return status.error();
    }
    if (!is_adaptive) return spacing;
    if (auto status = check_refined_count(max_count); !status) return status.error();
    // A huge number of candidates is a mistake, even though the spacing grows below.
    constexpr uint64_t kAnything = 1'000'000'000;
    auto status = check_candidate_count(*count, kAnything, std::numeric_limits<uint64_t>::max());
    if (!status) return status.error();
    while (*count > static_cast<double>(std::max<uint64_t>(max_count / 2, 8))) {
        spacing *= kWider;
        count = lattice_count(bounds, spacing);
    }
    return spacing;
}

Result<double> checked_clearance(const glm::dvec3& spacing, const ProbeGridSettings& settings) {
    const double longest = settings.mode == PlacementMode::Adaptive ? 0.05 : 0.25;
    const double usual = std::min(tenth_of(spacing), longest);
    return checked_length("clearance", settings.clearance.value_or(usual));
}

Result<double> checked_agent_radius(const glm::dvec3& spacing, const ProbeGridSettings& settings) {
    constexpr double kLongest = 0.25;
    const double usual = std::min(tenth_of(spacing), kLongest);
    return checked_length("agent_radius", settings.agent_radius.value_or(usual));
}

}  // namespace tetralight
