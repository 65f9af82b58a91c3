// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

struct GltfLights {
    std::vector<Light> lights;
    /// The node's name, else the light's.
    std::vector<std::string> names;
    /// What is left out or ambiguous.
    PartList parts;
};

/// The lights of the nodes, placed in the world. Leaves out those to which a scale of 0 leaves no
/// direction.
[[nodiscard]] Result<GltfLights> read_lights(const GltfDocument& document,
                                             std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
