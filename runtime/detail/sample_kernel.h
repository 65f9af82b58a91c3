// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tetralight::detail {

/// constant + x (x1 + xx x + xy y + xz z) + y (y1 − xx y + yz z) + z (z1 + zz z).
struct NormalPolynomial {
    float constant, x1, xx, xy, xz, y1, yz, z1, zz;

    [[nodiscard]] float at(float x, float y, float z) const {
        return constant + x * (x1 + xx * x + xy * y + xz * z) + y * (y1 - xx * y + yz * z) +
               z * (z1 + zz * z);
    }
};

/// Normals and their light: one array per coordinate and per channel.
struct NormalArrays {
    const float* x;
    const float* y;
    const float* z;
    float* red;
    float* green;
    float* blue;
};

/// Evaluates three polynomials at `count` normals with the best instruction set of the processor.
/// Only in builds with Highway.
void sample_fastest(const NormalPolynomial* polynomials, const NormalArrays& arrays,
                    size_t count) noexcept;

/// The scalar code: the remainder [begin, count) after the vector code, or all without Highway.
inline void sample_rest(const NormalPolynomial* polynomials, const NormalArrays& arrays,
                        size_t begin, size_t count) {
    for (size_t i = begin; i < count; ++i) {
        const float x = arrays.x[i], y = arrays.y[i], z = arrays.z[i];
        arrays.red[i] = polynomials[0].at(x, y, z);
        arrays.green[i] = polynomials[1].at(x, y, z);
        arrays.blue[i] = polynomials[2].at(x, y, z);
    }
}

}  // namespace tetralight::detail
