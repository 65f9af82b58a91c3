// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

// What the tests of the generator share.

namespace tetralight::test {

inline ProbeGridSettings settings_for(const WorldBox& bounds, double spacing) {
    ProbeGridSettings settings;
    settings.spacing = glm::dvec3(spacing);
    settings.bounds = bounds;
    return settings;
}

inline ProbeGrid grid_of(const Scene& scene, const ProbeGridSettings& settings) {
    auto grid = make_probe_grid(scene, settings);
    EXPECT_TRUE(grid) << error_text(grid.error());
    return grid ? std::move(*grid) : ProbeGrid{};
}

inline std::string error_of(const Scene& scene, const ProbeGridSettings& settings) {
    const auto grid = make_probe_grid(scene, settings);
    return grid ? "(no error)" : error_text(grid.error());
}

inline std::vector<glm::dvec3> positions_of(const ProbeGrid& grid) {
    std::vector<glm::dvec3> all;
    for (const ProbeGroup& group : grid.groups) {
        all.insert(all.end(), group.positions.begin(), group.positions.end());
    }
    return all;
}

/// Distinct coordinates along one axis.
inline std::vector<double> layers(const ProbeGrid& grid, int axis) {
    std::set<double> found;
    for (const glm::dvec3& p : positions_of(grid)) found.insert(p[axis]);
    return {found.begin(), found.end()};
}

inline Material grey() {
    return diffuse(glm::vec3(0.5f));
}

inline Material two_sided() {
    Material material = grey();
    material.is_double_sided = true;
    return material;
}

}  // namespace tetralight::test
