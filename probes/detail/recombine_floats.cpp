// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/half.h>
#include <tetralight/probes/detail/recombine_kernel.h>

namespace tetralight::detail {

void recombine_floats(const RecombineBlock& block) noexcept {
    for (size_t i = 0; i < block.count; ++i) {
        float sum = block.weights[0] * block.layers[i];
        for (size_t k = 1; k < block.weights.size(); ++k) {
            sum += block.weights[k] * block.layers[k * block.layer_stride + i];
        }
        block.sums[i] = sum;
        if (block.halves != nullptr) block.halves[i] = half_from_float(sum * block.half_factor);
    }
}

}  // namespace tetralight::detail
