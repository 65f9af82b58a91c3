// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lppv_grid_options.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/lppv_object.h>

namespace tetralight::cli {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

/// True if a box has no thickness along an axis, up to rounding.
bool is_flat(const LppvGrid& grid, int axis) {
    const glm::dvec3 size = grid.max - grid.min;
    return size[axis] <= 1e-9 * std::max({size.x, size.y, size.z});
}

}  // namespace

LppvGridOptions::LppvGridOptions(const Values& values)
    : object(values.text("object")),
      bounds(values.numbers("bounds")),
      orientation(values.numbers("orientation")),
      values_(&values) {
    for (const double count : values.numbers("resolution")) {
        resolution.push_back(static_cast<uint32_t>(count));
    }
    settings.bounds = choice<LppvBounds>(values, "axes");
    settings.density = values.number("density");
    settings.placement = choice<LppvPlacement>(values, "placement");
    if (values.flag("unity_limits")) settings.limits = LppvLimits::Unity;
    check_usage();
}

/// Floats hold positions of queries: those of neighboring points have to differ.
void LppvGridOptions::check_spacing(const LppvGrid& grid) const {
    const glm::dvec3 a = glm::abs(grid.world_position({0, 0, 0}));
    const glm::dvec3 b = glm::abs(grid.world_position(grid.resolution - 1u));
    const double farthest = std::max({a.x, a.y, a.z, b.x, b.y, b.z});
    const glm::dvec3 spacing = grid.spacing();
    for (int i = 0; i < 3; ++i) {
        const bool is_one = is_flat(grid, i) || grid.resolution[i] == 1;
        if (is_one || spacing[i] > farthest * std::numeric_limits<float>::epsilon()) continue;
        refuse(*values_, "bounds",
               str_cat("floats cannot tell grid points ", spacing[i], " m apart at ", farthest,
                       " m from the origin"));
    }
}

void LppvGridOptions::check_usage() const {
    for (size_t i = 0; i < 3 && !bounds.empty(); ++i) {
        if (bounds[i] <= bounds[i + 3]) continue;
        refuse(*values_, "bounds",
               str_cat("reversed along ", kAxes[i], ": ", bounds[i], " to ", bounds[i + 3]));
    }
    if (!orientation.empty() && std::ranges::count(orientation, 0.0) == 4) {
        refuse(*values_, "orientation", "0,0,0,0 is not a rotation");
    }
    if (resolution.empty()) return;
    const LppvPart unit{glm::dmat4(1.0), glm::dvec3(0.0), glm::dvec3(1.0)};
    const auto grid = make_grid({glm::dmat4(1.0), std::span(&unit, 1)}, settings);
    if (!grid) refuse_because(*values_, "resolution", grid.error());
}

Result<LppvGrid> LppvGridOptions::make_grid(const LppvObject& wrapped,
                                            const LppvSettings& chosen) const {
    if (resolution.empty()) return make_lppv_grid(wrapped, chosen);
    LppvSettings custom = chosen;
    custom.resolution_mode = LppvResolution::Custom;
    custom.resolution = {resolution[0], resolution[1], resolution[2]};
    const auto grid = make_lppv_grid(wrapped, custom);
    if (!grid) return grid;
    for (int i = 0; i < 3; ++i) {
        if (is_flat(*grid, i)) custom.resolution[i] = 1;
    }
    return make_lppv_grid(wrapped, custom);
}

Result<LppvGrid> LppvGridOptions::make_grid(const Scene& scene,
                                            const ProbeVolumeView& volume) const {
    if (!object.empty()) {
        const auto found = find_object(scene, object);
        if (!found) return found.error();
        auto grid = make_grid(found->view(), settings);
        if (!grid) return grid.error().in(found->place);
        return grid;
    }
    const Box<glm::vec3> probes = probe_bounds(volume);
    LppvPart world{glm::dmat4(1.0), volume.info.world_origin + glm::dvec3(probes.min),
                   volume.info.world_origin + glm::dvec3(probes.max)};
    LppvSettings chosen = settings;
    chosen.bounds = LppvBounds::AutomaticWorld;
    if (!bounds.empty()) {
        world.min = {bounds[0], bounds[1], bounds[2]};
        world.max = {bounds[3], bounds[4], bounds[5]};
    }
    if (!orientation.empty()) {
        chosen.bounds = LppvBounds::Custom;
        chosen.custom_box = {
            0.5 * (world.min + world.max), world.max - world.min,
            glm::dquat(orientation[3], orientation[0], orientation[1], orientation[2])};
    }
    auto grid = make_grid({glm::dmat4(1.0), std::span(&world, 1)}, chosen);
    if (!grid) refuse_because(*values_, "density", grid.error());
    if (!bounds.empty()) check_spacing(*grid);
    return grid;
}

std::vector<std::string> LppvGridOptions::warnings(const LppvGrid& grid) const {
    std::vector<std::string> lines;
    for (int i = 0; i < 3 && !resolution.empty(); ++i) {
        const uint32_t asked = resolution[static_cast<size_t>(i)];
        if (asked == 1 || !is_flat(grid, i)) continue;
        lines.push_back(str_cat("the box has no thickness along ", kAxes[i],
                                ": one grid point there, not ", asked));
    }
    return lines;
}

}  // namespace tetralight::cli
