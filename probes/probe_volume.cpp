// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/probe_volume.h>

namespace tetralight {
namespace {

template <class T>
std::vector<T> copy(std::span<const T> elements) {
    return {elements.begin(), elements.end()};
}

}  // namespace

ProbeVolumeView ProbeVolume::view() const noexcept {
    return {info,
            positions,
            irradiance,
            occlusion,
            validity,
            health,
            compact,
            exact_positions,
            cells,
            hull_rays,
            seeds,
            sources,
            group_names,
            lights,
            light_names,
            metadata,
            light_states,
            occlusion_lights,
            layers,
            layer_names,
            layer_irradiance,
            transfer,
            sky,
            dering};
}

ProbeVolume copy_volume(const ProbeVolumeView& view) {
    ProbeVolume volume;
    volume.info = view.info;
    volume.positions = copy(view.positions);
    volume.irradiance = copy(view.irradiance);
    volume.occlusion = copy(view.occlusion);
    volume.validity = copy(view.validity);
    volume.health = copy(view.health);
    volume.compact = copy(view.compact);
    volume.exact_positions = copy(view.exact_positions);
    volume.cells = copy(view.cells);
    volume.hull_rays = copy(view.hull_rays);
    volume.seeds = copy(view.seeds);
    volume.sources = copy(view.sources);
    volume.group_names = view.group_names;
    volume.lights = copy(view.lights);
    volume.light_names = view.light_names;
    volume.metadata = view.metadata;
    volume.light_states = copy(view.light_states);
    volume.occlusion_lights = copy(view.occlusion_lights);
    volume.layers = copy(view.layers);
    volume.layer_names = view.layer_names;
    volume.layer_irradiance = copy(view.layer_irradiance);
    volume.transfer = copy(view.transfer);
    volume.sky = copy(view.sky);
    volume.dering = copy(view.dering);
    return volume;
}

std::vector<std::string_view> split_names(std::string_view names) {
    std::vector<std::string_view> lines;
    while (!names.empty()) {
        const size_t end = names.find('\n');
        lines.push_back(names.substr(0, end));
        names.remove_prefix(end == std::string_view::npos ? names.size() : end + 1);
    }
    return lines;
}

}  // namespace tetralight
