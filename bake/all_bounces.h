// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight {

/// The number of reflections that stands for all light, and the default. Russian roulette ends
/// paths long before: after the first reflections a path continues with a probability of at most
/// 0.99, so that one in 20 000 reaches this limit if no surface absorbs light, and about none in
/// rooms of the whitest paint. A smaller number cuts paths, and loses the light of longer ones.
inline constexpr uint32_t kAllBounces = 1000;

}  // namespace tetralight
