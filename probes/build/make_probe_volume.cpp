// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_probe_volume.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/probes/build/detail/local_origin.h>
#include <tetralight/probes/build/hull_rays.h>
#include <tetralight/probes/build/make_seed_grid.h>

namespace tetralight {
namespace {

/// One a probe; empty if all probes are on all layers.
std::vector<uint32_t> rendering_layers(const MergedProbes& probes) {
    const auto& groups = probes.group_rendering_layers;
    const auto is_all = [](uint32_t layers) { return layers == kAllRenderingLayers; };
    if (std::ranges::all_of(groups, is_all)) return {};
    std::vector<uint32_t> layers(probes.positions.size(), 0);
    for (const ProbeSource& source : probes.sources) {
        if (source.probe != kNoIndex) layers[source.probe] |= groups[source.group];
    }
    return layers;
}

}  // namespace

ProbeVolume make_probe_volume(const MergedProbes& probes) {
    return make_probe_volume(probes, tetrahedralize(probes.positions, flat_tolerance(probes)));
}

ProbeVolume make_probe_volume(const MergedProbes& probes, Tetrahedralization cells) {
    HullRays hull = make_hull_rays(probes.positions, cells);

    ProbeVolume volume;
    volume.info.world_origin = detail::local_origin(probes.positions);
    volume.info.axis = cells.axis;
    volume.info.dimension = cells.dimension;
    volume.info.inner_cell_count = cells.inner_cell_count;
    volume.info.radial_fraction = hull.radial_fraction;
    volume.positions.reserve(probes.positions.size());
    for (const glm::dvec3& p : probes.positions) {
        const glm::vec3 local(p - volume.info.world_origin);
        volume.positions.push_back(local);
        volume.info.extent = std::max(volume.info.extent, glm::length(local));
    }
    volume.exact_positions = probes.positions;
    volume.cells = std::move(cells.cells);
    volume.hull_rays = std::move(hull.cells);
    volume.seed_grid = make_seed_grid(volume.view());
    volume.rendering_layers = rendering_layers(probes);
    volume.sources = probes.sources;
    for (const std::string& name : probes.group_names) volume.group_names += name + "\n";
    return volume;
}

}  // namespace tetralight
