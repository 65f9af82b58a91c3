// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/cli/values.h>

namespace tetralight::cli {

/// What `grid` is to do, from its settings. Throws a `UsageError` if some do not go together.
[[nodiscard]] ProbeGridSettings grid_settings(const Values& values);

}  // namespace tetralight::cli
