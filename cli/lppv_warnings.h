// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/pipeline/write_lppv.h>

namespace tetralight::cli {

/// One line for each part of a proxy volume that its file cannot hold: light above the largest
/// half, occlusion, band 2.
[[nodiscard]] std::vector<std::string> lppv_warnings(const Lppv& lppv,
                                                     const LppvFileSettings& file);

/// The first of them, of any file. `largest` is the largest magnitude that it was to hold.
[[nodiscard]] std::vector<std::string> half_warnings(float largest, const LppvFileSettings& file);

}  // namespace tetralight::cli
