// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include <tetralight/base/result.h>

// The subcommands, one file each. `add_X` declares the options on `app` and sets `run` when the
// user chose the subcommand.

namespace tetralight::cli {

using Run = std::function<Status()>;

void add_bake(CLI::App& app, Run& run);
void add_grid(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_lppv(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
void add_meshball(CLI::App& app, Run& run);
void add_query(CLI::App& app, Run& run);
void add_relight(CLI::App& app, Run& run);
void add_render(CLI::App& app, Run& run);
void add_tetrahedralize(CLI::App& app, Run& run);
void add_validate(CLI::App& app, Run& run);

}  // namespace tetralight::cli
