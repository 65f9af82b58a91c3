// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// Writes probe groups as a binary glTF scene (.glb): a node with POINTS for each group, which
/// every glTF viewer shows and `read_gltf` reads (`extras.light_probe_group`). Positions are floats
/// relative to the group's first probe, so that their error is about 1e-7 of the group's size even
/// far from the origin. Returns the errors of `write_probe_groups`.
[[nodiscard]] Status write_probe_groups_glb(const std::string& path,
                                            std::span<const ProbeGroup> groups);

}  // namespace tetralight
