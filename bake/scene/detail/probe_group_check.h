// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight::detail {

/// How messages name a group: `group "hall"`, or `group 3` if the name is not known.
[[nodiscard]] std::string group_place(size_t group_index, const std::string& name);

/// Returns corrupt, with the field `groups[1].positions[7]`, unless the names are unique and not
/// empty, positions are finite, and transforms are finite and affine.
[[nodiscard]] Status check_probe_groups(std::span<const ProbeGroup> groups);

/// The same, and returns invalid_argument if there are no groups or a name is not UTF-8.
[[nodiscard]] Status check_writable_groups(std::span<const ProbeGroup> groups);

}  // namespace tetralight::detail
