// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight {

/// The largest distance of a probe from the origin of the world, metres.
inline constexpr double kFarthestPosition = 1e18;

}  // namespace tetralight
