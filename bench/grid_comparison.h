// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <tetralight/bench/grid_error.h>

namespace tetralight::bench {

struct GridComparison {
    /// For each count: the error (`LightErrors::rms`) of adaptive probes over that of as many
    /// regular ones.
    std::vector<double> ratios;
    /// Adaptive probes with the error of the largest regular grid, over the probes of that. None of
    /// a single count.
    std::optional<double> probes_for_error;
    /// Probes inside closed meshes, of all grids.
    double inside_count = 0.0;
};

/// Measures adaptive grids against regular ones of the same numbers of probes, and reports their
/// errors, cover, dark probes, and numbers of probes made.
[[nodiscard]] GridComparison compare_grids(const GridSubject& subject, const Options& options);

}  // namespace tetralight::bench
