// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The adjustment volumes of all nodes that have `extras.probe_adjustment`: a box with its `size`,
/// or a sphere with its `radius`, under the node's transform.
[[nodiscard]] Result<std::vector<ProbeAdjustment>> read_gltf_probe_adjustments(
    const GltfDocument& document, std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
