// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/scene.h>

// Mistakes of units that exporters make, found in what they write. They are guesses: rows of the
// table with a remedy, and warnings.

namespace tetralight::detail {

/// Adds a row if lights are in lumens of watts beside emission or a sky in watts, as in files of
/// Blender's "Standard" lighting mode. `has_other_sky`: the scene gets a sky that is not in the
/// file. Precondition: the document's intensities are those of the file.
void add_light_unit(const GltfDocument& document, const Scene& scene, bool has_other_sky,
                    PartList& parts);

/// Adds a row if the objects are so large that their unit is more likely a centimetre than a metre:
/// most of three and more, or all of a scene whose lamps are far from every surface.
void add_length_unit(const Scene& scene, PartList& parts);

}  // namespace tetralight::detail
