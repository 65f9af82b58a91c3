// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/lightmap/lightmaps.h>

namespace tetralight {

/// Calls `visit(section, owner, view)` for each member of lightmaps but `info`, in the order of the
/// file: the name of its section, and pointers to the member of `Lightmaps` and `LightmapsView`.
/// Views, copies and files follow from this list. To add a member, add it to both structs and here.
template <class Visit>
constexpr void for_each_lightmap_member(Visit&& visit) {
    using Owner = Lightmaps;
    using View = LightmapsView;
    visit("irradiance", &Owner::irradiance, &View::irradiance);
    visit("light", &Owner::light, &View::light);
    visit("rectangles", &Owner::rectangles, &View::rectangles);
    visit("instance_names", &Owner::instance_names, &View::instance_names);
    visit("meshes", &Owner::meshes, &View::meshes);
    visit("corner_uvs", &Owner::corner_uvs, &View::corner_uvs);
    visit("validity", &Owner::validity, &View::validity);
    visit("error", &Owner::error, &View::error);
    visit("shadow_mask", &Owner::shadow_mask, &View::shadow_mask);
    visit("ambient_occlusion", &Owner::ambient_occlusion, &View::ambient_occlusion);
    visit("layers", &Owner::layers, &View::layers);
    visit("layer_names", &Owner::layer_names, &View::layer_names);
    visit("layer_irradiance", &Owner::layer_irradiance, &View::layer_irradiance);
    visit("layer_light", &Owner::layer_light, &View::layer_light);
    visit("metadata", &Owner::metadata, &View::metadata);
}

}  // namespace tetralight
