// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace tetralight::bench {

/// A mesh to unwrap.
struct UnwrapShape {
    std::vector<glm::vec3> positions;
    std::span<const uint32_t> indices;
};

struct WatlasResult {
    double charts = 0.0;
    /// Median of the runs.
    double cpu_seconds = 0.0;
};

/// Unwraps and packs each mesh for itself with watlas (viewer/bench/watlas.mjs). Empty, with a line
/// on stderr, if Node or the package is not installed.
[[nodiscard]] std::optional<WatlasResult> unwrap_with_watlas(std::span<const UnwrapShape> shapes,
                                                             double texels_per_meter, int runs);

}  // namespace tetralight::bench
