// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace tetralight {

/// The variance of a texel's light, with the help of the texels around it: its own few samples tell
/// little about it. The median of three: by its own samples (`own`), the mean of the texels around
/// it (`around`), and its light times their relative variance. The second alone is too large for
/// dark texels beside bright ones, and the third is wrong where light without noise ends. `square`
/// and `square_around`: the square of its light, and the mean of these.
[[nodiscard]] inline double pooled_variance(double own, double around, double square,
                                            double square_around) noexcept {
    const double relative = square_around > 0.0 ? around / square_around * square : 0.0;
    return std::max(std::min(own, around), std::min(relative, std::max(own, around)));
}

}  // namespace tetralight
