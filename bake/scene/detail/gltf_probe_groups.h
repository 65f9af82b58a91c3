// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The probe groups of a scene, and the nodes that are probes and not objects.
struct GltfProbeGroups {
    std::vector<ProbeGroup> groups;
    /// For each node of the document: true if it is a probe.
    std::vector<bool> is_probe;
};

[[nodiscard]] Result<GltfProbeGroups> read_gltf_probe_groups(const GltfDocument& document,
                                                             std::span<const GltfWorldNode> nodes);

}  // namespace tetralight::detail
