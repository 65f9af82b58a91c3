// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/probe_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/survey.h"
#include "base/text.h"

namespace tetralight {
namespace {

constexpr const char* kAxisNames[] = {"x", "y", "z"};
constexpr int kUp = 1;

/// Layers of the lattice along one axis.
struct Layers {
    double first = 0.0;
    double spacing = 1.0;
    double count = 0.0;  // may be beyond any integer until it was checked
};

Layers layers_along(const Box& bounds, double spacing, int axis) {
    const double size = bounds.high[axis] - bounds.low[axis];
    // What is short of a whole spacing by rounding only (bounds come from float vertices) is whole.
    const double count = std::max(2.0, std::floor(size / spacing + 1e-6));
    const double centered = bounds.low[axis] + 0.5 * (size - (count - 1.0) * spacing);
    const double standing = bounds.low[axis] + 0.5 * spacing;
    return {axis == kUp ? std::max(centered, standing) : centered, spacing, count};
}

Status check(const Box& bounds, const glm::dvec3& spacing) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(spacing[axis] > 0.0) || !std::isfinite(spacing[axis])) {
            return Error{text("spacing ", spacing[axis], " along ", kAxisNames[axis],
                              " is not a positive length")};
        }
        const double low = bounds.low[axis], high = bounds.high[axis];
        if (!std::isfinite(low) || !std::isfinite(high) || high < low) {
            return Error{text("bounds ", low, " to ", high, " along ", kAxisNames[axis],
                              " are empty or not finite")};
        }
    }
    return Ok{};
}

Result<Box> bounds_to_fill(const Scene& scene, const ProbeGridSettings& settings) {
    if (settings.bounds) return *settings.bounds;
    const auto bounds =
        scene_bounds(scene, [](const MeshInstance& instance) { return instance.contributes_gi; });
    if (!bounds) return Error{"the scene has no static geometry to take bounds from"};
    return *bounds;
}

std::vector<glm::dvec3> lattice(const std::array<Layers, 3>& layers) {
    std::vector<glm::dvec3> positions;
    for (double y = 0; y < layers[1].count; ++y) {
        for (double z = 0; z < layers[2].count; ++z) {
            for (double x = 0; x < layers[0].count; ++x) {
                positions.emplace_back(layers[0].first + x * layers[0].spacing,
                                       layers[1].first + y * layers[1].spacing,
                                       layers[2].first + z * layers[2].spacing);
            }
        }
    }
    return positions;
}

}  // namespace

Result<ProbeGrid> make_probe_grid(const Scene& scene, const ProbeGridSettings& settings) {
    const auto bounds = bounds_to_fill(scene, settings);
    if (!bounds) return bounds.error();
    if (auto status = check(*bounds, settings.spacing); !status) return status.error();
    std::array<Layers, 3> layers;
    for (int axis = 0; axis < 3; ++axis) {
        layers[axis] = layers_along(*bounds, settings.spacing[axis], axis);
    }
    const double count = layers[0].count * layers[1].count * layers[2].count;
    if (!(count <= static_cast<double>(settings.max_probe_count))) {
        return Error{text("a grid of ", count, " probes is more than the limit of ",
                          settings.max_probe_count)};
    }

    const std::vector<glm::dvec3> candidates = lattice(layers);
    const auto surroundings = survey(scene, candidates, settings.thread_count);
    if (!surroundings) return surroundings.error();
    ProbeGrid grid;
    grid.group.name = settings.group_name;
    grid.candidate_count = candidates.size();
    for (size_t i = 0; i < candidates.size(); ++i) {
        if ((*surroundings)[i].is_inside()) {
            ++grid.inside_count;
        } else {
            grid.group.positions.push_back(candidates[i]);
        }
    }
    if (grid.group.positions.empty()) {
        return Error{text("all ", candidates.size(), " grid positions lie inside geometry")};
    }
    return grid;
}

}  // namespace tetralight
