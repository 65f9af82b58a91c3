// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/pipeline/lppv_coverage.h>
#include <tetralight/pipeline/write_lppv.h>

namespace tetralight::cli {

/// One line for each part of a proxy volume that its file cannot hold: light above the largest
/// half, occlusion, band 2.
[[nodiscard]] std::vector<std::string> lppv_warnings(const Lppv& lppv,
                                                     const LppvFileSettings& file);

/// The first of them, of any file. `largest` is the largest magnitude that it was to hold.
[[nodiscard]] std::vector<std::string> half_warnings(float largest, const LppvFileSettings& file);

/// A line if more than 1 % of the points in free space are outside of the tetrahedra, and one if as
/// many see too little of their cell, each with up to three positions for probes.
[[nodiscard]] std::vector<std::string> coverage_warnings(const LppvCoverage& coverage);

}  // namespace tetralight::cli
