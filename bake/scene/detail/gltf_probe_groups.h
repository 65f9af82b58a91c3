// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The probe groups of a scene, and which nodes are probes rather than objects.
struct GltfProbeGroups {
    std::vector<ProbeGroup> groups;
    /// One for each node of the document.
    std::vector<bool> is_probe;
};

[[nodiscard]] Result<GltfProbeGroups> read_gltf_probe_groups(const GltfDocument& document,
                                                             std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
