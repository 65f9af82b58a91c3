// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/commands.h>

namespace tetralight::cli {

/// The one subcommand that a build may be without (TETRALIGHT_BUILD_SERVER).
void add_serve(CLI::App& app, Run& run);

}  // namespace tetralight::cli
