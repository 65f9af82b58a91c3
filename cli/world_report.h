// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/pipeline/write_world.h>

namespace tetralight::cli {

/// Prints what a world has: tiles, probes, bytes.
void report_world(const std::string& folder, const WorldSummary& summary,
                  const CommonOptions& common);

/// The same of a folder, after all of its tiles were opened and verified.
[[nodiscard]] Status show_world(const std::string& folder, const CommonOptions& common);

}  // namespace tetralight::cli
