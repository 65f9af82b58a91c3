// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/half.h>
#include <tetralight/probes/detail/half_kernel.h>

namespace tetralight::detail {

void write_halves_scalar(std::span<const float> floats, uint16_t* halves) noexcept {
    for (size_t i = 0; i < floats.size(); ++i) halves[i] = half_from_float(floats[i]);
}

}  // namespace tetralight::detail
