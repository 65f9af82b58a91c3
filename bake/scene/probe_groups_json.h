// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// Reads a probe-group file:
///
///     { "groups": [ { "name": "hall",
///                     "transform": [16 numbers, column-major, world from group],   (optional)
///                     "dering": false,                                             (optional)
///                     "rendering_layers": [0, 3],                                  (optional)
///                     "positions": [[x, y, z], ...] } ] }
///
/// There may be no group, and groups may have no probes. Returns corrupt, with the member as the
/// field (`groups[1].positions[7]`), for two groups of one name, unknown keys, a transform that is
/// not affine, numbers that are not finite, a list of rendering layers that is empty or has
/// other numbers than 0 to 31, and more than 64 levels of nesting.
[[nodiscard]] Result<std::vector<ProbeGroup>> read_probe_groups(const std::string& path);

/// Writes a file that `read_probe_groups` reads; numbers keep their bits. Returns invalid_argument
/// if there are no groups or a name is not UTF-8, and corrupt for what the reader would refuse.
[[nodiscard]] Status write_probe_groups(const std::string& path,
                                        std::span<const ProbeGroup> groups);

/// The group that the field of an error names: 1 for `groups[1].positions[7]`.
[[nodiscard]] std::optional<size_t> probe_group_index(std::string_view field);

}  // namespace tetralight
