// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight::detail {

/// Adds a row for each kind of thing that a scene has.
void add_contents(const Scene& scene, PartList& parts);

}  // namespace tetralight::detail
