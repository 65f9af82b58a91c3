// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Which code reads a member of a volume.
enum class MemberUse : uint8_t {
    Query,    ///< `locate` and `interpolate`
    Offline,  ///< everything else; of a mapped file it may stay on disk
};

/// Calls `visit(section, use, owner, view)` for each member of a volume but `info`, in the order of
/// the file: the name of its section, and pointers to the member of `ProbeVolume` and
/// `ProbeVolumeView`. Views, copies and files follow from this list. To add a member, add it to
/// both structs and here.
template <class Visit>
constexpr void for_each_volume_member(Visit&& visit) {
    using Owner = ProbeVolume;
    using View = ProbeVolumeView;
    using enum MemberUse;
    visit("compact", Query, &Owner::compact, &View::compact);
    visit("positions", Query, &Owner::positions, &View::positions);
    visit("cells", Query, &Owner::cells, &View::cells);
    visit("hull_rays", Query, &Owner::hull_rays, &View::hull_rays);
    visit("seeds", Query, &Owner::seeds, &View::seeds);
    visit("seed_grid", Query, &Owner::seed_grid, &View::seed_grid);
    visit("visibility_blocks", Query, &Owner::visibility_blocks, &View::visibility_blocks);
    visit("cell_visibility", Query, &Owner::cell_visibility, &View::cell_visibility);
    visit("rendering_layers", Query, &Owner::rendering_layers, &View::rendering_layers);
    visit("irradiance", Query, &Owner::irradiance, &View::irradiance);
    visit("occlusion", Query, &Owner::occlusion, &View::occlusion);
    visit("validity", Offline, &Owner::validity, &View::validity);
    visit("health", Offline, &Owner::health, &View::health);
    visit("exact_positions", Offline, &Owner::exact_positions, &View::exact_positions);
    visit("sources", Offline, &Owner::sources, &View::sources);
    visit("group_names", Offline, &Owner::group_names, &View::group_names);
    visit("lights", Offline, &Owner::lights, &View::lights);
    visit("light_names", Offline, &Owner::light_names, &View::light_names);
    visit("metadata", Offline, &Owner::metadata, &View::metadata);
    visit("light_states", Offline, &Owner::light_states, &View::light_states);
    visit("occlusion_lights", Offline, &Owner::occlusion_lights, &View::occlusion_lights);
    visit("layers", Offline, &Owner::layers, &View::layers);
    visit("layer_names", Offline, &Owner::layer_names, &View::layer_names);
    visit("layer_irradiance", Offline, &Owner::layer_irradiance, &View::layer_irradiance);
    visit("layer_errors", Offline, &Owner::layer_errors, &View::layer_errors);
    visit("transfer", Offline, &Owner::transfer, &View::transfer);
    visit("sky", Offline, &Owner::sky, &View::sky);
    visit("dering", Offline, &Owner::dering, &View::dering);
}

}  // namespace tetralight
