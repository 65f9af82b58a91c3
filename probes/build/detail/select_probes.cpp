// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/select_probes.h>

#include <vector>

#include <tetralight/probes/edge_visibility.h>

namespace tetralight::detail {
namespace {

/// An array with one element a probe, or layer after layer with one a probe each; or empty.
template <class T>
void select_each(std::span<const T> from, std::span<const uint32_t> probes, size_t probe_count,
                 std::vector<T>& to) {
    if (from.empty()) return;
    to.reserve(from.size() / probe_count * probes.size());
    for (size_t begin = 0; begin < from.size(); begin += probe_count) {
        for (const uint32_t probe : probes) to.push_back(from[begin + probe]);
    }
}

template <class T>
std::vector<T> copy_of(std::span<const T> from) {
    return {from.begin(), from.end()};
}

}  // namespace

ProbeVolume select_probes(const ProbeVolumeView& volume, std::span<const uint32_t> probes,
                          std::span<const uint32_t> places) {
    ProbeVolume part;
    part.info = volume.info;
    part.info.seed_cube = {};
    const size_t count = volume.positions.size();
    select_each(volume.positions, probes, count, part.positions);
    select_each(volume.irradiance, probes, count, part.irradiance);
    select_each(volume.occlusion, probes, count, part.occlusion);
    select_each(volume.validity, probes, count, part.validity);
    select_each(volume.health, probes, count, part.health);
    select_each(volume.compact, probes, count, part.compact);
    select_each(volume.exact_positions, probes, count, part.exact_positions);
    select_each(volume.rendering_layers, probes, count, part.rendering_layers);
    select_each(volume.occlusion_lights, probes, count, part.occlusion_lights);
    select_each(volume.layer_irradiance, probes, count, part.layer_irradiance);
    select_each(volume.layer_errors, probes, count, part.layer_errors);
    select_each(volume.transfer, probes, count, part.transfer);
    select_each(volume.dering, probes, count, part.dering);
    for (const ProbeSource& source : volume.sources) {
        if (source.probe == kNoIndex || places[source.probe] == kNoIndex) continue;
        part.sources.push_back({source.group, source.index, places[source.probe]});
    }
    part.group_names = volume.group_names;
    part.lights = copy_of(volume.lights);
    part.light_names = volume.light_names;
    part.metadata = volume.metadata;
    part.light_states = copy_of(volume.light_states);
    part.layers = copy_of(volume.layers);
    part.layer_names = volume.layer_names;
    part.sky = copy_of(volume.sky);
    return part;
}

void select_visibility(const ProbeVolumeView& volume, std::span<const uint32_t> cells,
                       ProbeVolume& part) {
    if (volume.visibility_blocks.empty()) return;
    part.visibility_blocks.resize((part.cells.size() + 31) / 32);
    for (size_t block = 0; block < part.visibility_blocks.size(); ++block) {
        VisibilityBlock& marked = part.visibility_blocks[block];
        marked.first = static_cast<uint32_t>(part.cell_visibility.size());
        for (size_t cell = 32 * block; cell < 32 * (block + 1) && cell < cells.size(); ++cell) {
            const uint32_t element = find_visibility(volume, cells[cell]);
            if (element == kNoIndex) continue;
            marked.cells |= uint32_t{1} << (cell % 32);
            part.cell_visibility.push_back(volume.cell_visibility[element]);
        }
    }
}

}  // namespace tetralight::detail
