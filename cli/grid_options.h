// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/placement/probe_grid.h>

namespace tetralight::cli {

/// Where `grid` puts probes, as options.
struct GridOptions {
    ProbeGridSettings settings;

    void add_to(CLI::App& command);

    /// What no option can tell of itself.
    void check_usage() const;

    /// Takes over what was given; to be called before `settings` is used.
    void finish();

  private:
    void add_bounds(CLI::App& command);
    void add_rules(CLI::App& command);
    void add_reach(CLI::App& command);
    void add_adaptive(CLI::App& command);

    WorldBox bounds_;
    double clearance_ = 0.0;
    std::vector<std::string> seeds_;
    CLI::Option* low_option_ = nullptr;
    CLI::Option* clearance_option_ = nullptr;
    CLI::Option* heights_option_ = nullptr;
    CLI::Option* spacing_option_ = nullptr;
    std::vector<CLI::Option*> adaptive_options_;
};

}  // namespace tetralight::cli
