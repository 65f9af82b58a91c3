// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The reflection probes of all nodes that have `extras.reflection_probe`: at the origins of their
/// nodes, with boxes along the nodes' axes. Returns invalid_argument if a value is out of range, or
/// if the node has a scale of zero or is sheared.
[[nodiscard]] Result<std::vector<ReflectionPlace>> read_gltf_reflection_places(
    const GltfDocument& document, std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
