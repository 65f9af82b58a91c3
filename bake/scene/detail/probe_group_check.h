// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight::detail {

/// How messages name a group: `group "hall"`, or `group 3` where the name is not known.
[[nodiscard]] std::string group_place(size_t group_index, const std::string& name);

/// What every list of probe groups obeys: unique non-empty names, finite positions, finite
/// affine transforms.
[[nodiscard]] Status check_probe_groups(std::span<const ProbeGroup> groups);

}  // namespace tetralight::detail
