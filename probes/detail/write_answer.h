// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstring>
#include <span>

#include <tetralight/probes/detail/half_kernel.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/query_output.h>

namespace tetralight::detail {

/// Writes `kCount` values of one answer.
template <size_t kCount, class Value>
void write_values(const StridedOutput& output, size_t answer, const Value* values) {
    std::byte* to = output.memory.data() + answer * output.answer_stride;
    if (output.value_stride == sizeof(Value)) {
        std::memcpy(to, values, kCount * sizeof(Value));
        return;
    }
    for (size_t k = 0; k < kCount; ++k) {
        std::memcpy(to + k * output.value_stride, values + k, sizeof(Value));
    }
}

/// Writes irradiance, given as 27 floats, in the format asked for.
inline void write_irradiance(const ShOutput& output, size_t answer, const float* coefficients) {
    switch (output.format) {
        case ShFormat::Coefficients:
            return write_values<27>(output, answer, coefficients);
        case ShFormat::Packed: {
            IrradianceSh sh;
            std::memcpy(static_cast<void*>(&sh), coefficients, sizeof sh);
            const PackedSh packed = pack_sh(sh);
            float values[28];
            std::memcpy(values, &packed, sizeof values);
            return write_values<28>(output, answer, values);
        }
        case ShFormat::Half: {
            std::array<uint16_t, 27> halves;
            write_halves(std::span(coefficients, halves.size()), halves.data());
            return write_values<27>(output, answer, halves.data());
        }
    }
}

}  // namespace tetralight::detail
