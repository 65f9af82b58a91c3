// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// Reads a probe-group file:
///
///     { "groups": [ { "name": "hall",
///                     "transform": [16 numbers, column-major, world from group],   (optional)
///                     "dering": false,                                             (optional)
///                     "positions": [[x, y, z], ...] } ] }
///
/// Two groups of one name, unknown keys, a transform that is not affine, numbers that are not
/// finite and more than 64 levels of nesting are errors that say where. There may be no group, and
/// groups may have no probes.
[[nodiscard]] Result<std::vector<ProbeGroup>> read_probe_groups(const std::string& path);

/// Writes what `read_probe_groups` reads; numbers come back bit for bit.
[[nodiscard]] Status write_probe_groups(const std::string& path,
                                        std::span<const ProbeGroup> groups);

}  // namespace tetralight
