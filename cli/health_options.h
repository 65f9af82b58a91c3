// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::cli {

/// Declares `--min-validity`, `--virtual-offset` and `--invalid-probes`.
void add_health_options(CLI::App& command, HealthSettings& settings);

/// Declares `--dering` and `--dering-window`.
void add_dering_options(CLI::App& command, DeringSettings& settings);

}  // namespace tetralight::cli
