// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probes/no_index.h"

namespace tetralight::detail {

/// For each grid point the index of the nearest valid one: itself where it is valid, kNoIndex where
/// none is. Exact for axes at right angles, `spacing` metres between points along each (0 counts as
/// 1). One pass over the lines of each axis: Felzenszwalb & Huttenlocher 2012, "Distance Transforms
/// of Sampled Functions", algorithm 1. Precondition: one value a point.
[[nodiscard]] std::vector<uint32_t> nearest_valid(glm::uvec3 resolution, glm::dvec3 spacing,
                                                  std::span<const float> validity,
                                                  float min_validity);

}  // namespace tetralight::detail
