// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

// Four floats in a vector extension of GCC and Clang. Operators work per element; comparisons
// return masks for `mask ? a : b`. The results have the same bits as four scalar operations.

namespace tetralight::detail {

using Float4 = float __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 splat(float x) noexcept {
    return Float4{x, x, x, x};
}

[[nodiscard]] inline Float4 min4(Float4 a, Float4 b) noexcept {
    return a < b ? a : b;
}

[[nodiscard]] inline Float4 max4(Float4 a, Float4 b) noexcept {
    return a > b ? a : b;
}

/// Compiles to one instruction with -fno-math-errno.
[[nodiscard]] inline Float4 sqrt4(Float4 x) noexcept {
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}

}  // namespace tetralight::detail
