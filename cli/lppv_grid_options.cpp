// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lppv_grid_options.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/validators.h>
#include <tetralight/pipeline/lppv_object.h>

namespace tetralight::cli {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Whether a box has no thickness along an axis, but for rounding.
bool is_flat(const LppvGrid& grid, int axis) {
    const glm::dvec3 size = grid.max - grid.min;
    return size[axis] <= 1e-9 * std::max({size.x, size.y, size.z});
}

/// Floats hold positions of queries: those of neighboring points have to differ.
void check_spacing(const LppvGrid& grid) {
    const glm::dvec3 a = glm::abs(grid.world_position({0, 0, 0}));
    const glm::dvec3 b = glm::abs(grid.world_position(grid.resolution - 1u));
    const double farthest = std::max({a.x, a.y, a.z, b.x, b.y, b.z});
    const glm::dvec3 spacing = grid.spacing();
    for (int i = 0; i < 3; ++i) {
        const bool is_one = is_flat(grid, i) || grid.resolution[i] == 1;
        if (is_one || spacing[i] > farthest * std::numeric_limits<float>::epsilon()) continue;
        throw CLI::ValidationError(
            "--bounds", str_cat("floats cannot tell grid points ", spacing[i], " m apart at ",
                                farthest, " m from the origin"));
    }
}

}  // namespace

void LppvGridOptions::add_to(CLI::App& command) {
    object_option = command.add_option("--object", object,
                                       "Node of the scene to wrap, with children that ask for it");
    object_option->check(not_empty("name"));
    auto* bounds_option = command.add_option(
        "--bounds", bounds,
        "World box to fill: low x,y,z, high x,y,z (default: that of the probes)");
    bounds_option->delimiter(',')->expected(6)->type_name("X,Y,Z,X,Y,Z")->excludes(object_option);
    bounds_option->check(positions());
    command
        .add_option("--orientation", orientation,
                    "Turn of the --bounds about their middle: a quaternion, as in glTF")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,Z,W")
        ->check(numbers_in(-1e9, 1e9).description(""))
        ->needs(bounds_option);
    add_choice(command, "--axes", settings.bounds,
               {{"object", LppvBounds::AutomaticLocal}, {"world", LppvBounds::AutomaticWorld}},
               "Along which axes an object's box lies")
        ->needs(object_option);
    auto* resolution_option =
        command.add_option("--resolution", resolution, "Grid points along each axis, up to 256");
    resolution_option->delimiter(',')->expected(3)->type_name("X,Y,Z");
    resolution_option->check(whole_numbers(UINT32_MAX, "2^32 - 1"));
    command.add_option("--density", settings.density, "Grid points a metre")
        ->check(numbers_in(1e-9, 1e9).description(""))
        ->excludes(resolution_option)
        ->capture_default_str();
    add_choice(command, "--placement", settings.placement,
               {{"corners", LppvPlacement::CellCorners}, {"centers", LppvPlacement::CellCenters}},
               "Points on the faces of the box, or half a spacing inside");
    command.add_flag_callback(
        "--unity-limits", [this] { settings.limits = LppvLimits::Unity; },
        "Round resolutions to powers of two up to 32, as Unity does");
}

void LppvGridOptions::check_usage() const {
    for (size_t i = 0; i < 3 && !bounds.empty(); ++i) {
        if (bounds[i] <= bounds[i + 3]) continue;
        throw CLI::ValidationError("--bounds", str_cat("reversed along ", kAxes[i], ": ", bounds[i],
                                                       " to ", bounds[i + 3]));
    }
    if (!orientation.empty() && std::ranges::count(orientation, 0.0) == 4) {
        throw CLI::ValidationError("--orientation", "0,0,0,0 is no turn");
    }
    if (resolution.empty()) return;
    const LppvPart unit{glm::dmat4(1.0), glm::dvec3(0.0), glm::dvec3(1.0)};
    const auto grid = make_grid({glm::dmat4(1.0), std::span(&unit, 1)}, settings);
    if (!grid) throw CLI::ValidationError("--resolution", error_text(grid.error()));
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
    if (!grid) throw CLI::ValidationError("--density", error_text(grid.error()));
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
