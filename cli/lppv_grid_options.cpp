// SPDX-License-Identifier: Apache-2.0
#include "cli/lppv_grid_options.h"

#include <limits>

#include "base/text.h"
#include "cli/choice.h"
#include "cli/common.h"
#include "pipeline/lppv_object.h"

namespace tetralight::cli {

void LppvGridOptions::add_to(CLI::App& command) {
    object_option = command.add_option("--object", object,
                                       "Node of the scene to wrap, with children that ask for it");
    auto* bounds_option = command.add_option(
        "--bounds", bounds,
        "World box to fill: low x,y,z, high x,y,z (default: that of the probes)");
    bounds_option->delimiter(',')->expected(6)->type_name("X,Y,Z,X,Y,Z")->excludes(object_option);
    add_choice(command, "--axes", settings.bounds,
               {{"object", LppvBounds::AutomaticLocal}, {"world", LppvBounds::AutomaticWorld}},
               "Along which axes an object's box lies")
        ->needs(object_option);
    auto* resolution_option =
        command.add_option("--resolution", resolution, "Grid points along each axis, up to 256");
    resolution_option->delimiter(',')->expected(3)->type_name("X,Y,Z");
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

Result<LppvGrid> LppvGridOptions::make_grid(const Scene& scene,
                                            const ProbeVolumeView& volume) const {
    LppvSettings chosen = settings;
    if (!resolution.empty()) {
        chosen.resolution_mode = LppvResolution::Custom;
        for (int i = 0; i < 3; ++i) {
            const uint64_t count = resolution[static_cast<size_t>(i)];
            constexpr uint64_t kLargest = std::numeric_limits<uint32_t>::max();
            chosen.resolution[i] = static_cast<uint32_t>(std::min(count, kLargest));
        }
    }
    if (!object.empty()) {
        const auto found = find_object(scene, object);
        if (!found) return found.error();
        return make_lppv_grid(found->view(), chosen);
    }
    const ProbeBounds probes = probe_bounds(volume);
    LppvPart world{glm::dmat4(1.0), volume.info.world_origin + glm::dvec3(probes.low),
                   volume.info.world_origin + glm::dvec3(probes.high)};
    if (!bounds.empty()) {
        world.low = {bounds[0], bounds[1], bounds[2]};
        world.high = {bounds[3], bounds[4], bounds[5]};
    }
    chosen.bounds = LppvBounds::AutomaticWorld;
    return make_lppv_grid({glm::dmat4(1.0), std::span(&world, 1)}, chosen);
}

}  // namespace tetralight::cli
