// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds the textures of materials that a mesh with the material cannot show, because it lacks the
/// set of texture coordinates: they are read as white there.
void add_missing_coordinates(const GltfDocument& document, PartList& parts);

}  // namespace tetralight::detail
