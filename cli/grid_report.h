// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// The grid in numbers: what was kept, pushed and dropped by reason, and how far probes stand from
/// surfaces.
[[nodiscard]] Json grid_json(const std::string& output, const ProbeGrid& grid);

/// The same as a table.
[[nodiscard]] std::string grid_text(const std::string& output, const ProbeGrid& grid);

/// One line for each of the largest spaces without probes, and for other deviations from the
/// settings.
[[nodiscard]] std::vector<std::string> grid_warnings(const ProbeGrid& grid,
                                                     const ProbeGridSettings& settings);

}  // namespace tetralight::cli
