// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight::cli {

/// Sums over directions and bounces stay far from the largest float, 3e38.
inline constexpr double kMaxRadiance = 1e30f;  // as floats hold it

/// A sky that the command line gives.
struct SkyOptions {
    /// Empty, a constant radiance, or a file.
    std::string sky;
    double intensity = 1.0;
    double rotation_degrees = 0.0;

    /// Declares `--sky`, `--sky-intensity` and `--sky-rotation`. `replaced`: what `--sky` takes the
    /// place of.
    void add_to(CLI::App& command, const std::string& replaced);

    /// Changes the environment of the file at `path`. Adds a warning when pixels had to be mended.
    [[nodiscard]] Status apply(const std::string& path, Environment& environment,
                               std::vector<std::string>& warnings) const;
};

}  // namespace tetralight::cli
