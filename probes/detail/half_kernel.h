// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace tetralight::detail {

/// Converts each float to the nearest half (`half_from_float`). Precondition: there is room for as
/// many halves. The scalar twin.
void write_halves_scalar(std::span<const float> floats, uint16_t* halves) noexcept;

#ifdef TETRALIGHT_HAS_HIGHWAY
/// The same bits by vector code. A NaN may get others.
void write_halves_in_vectors(std::span<const float> floats, uint16_t* halves) noexcept;
#endif

/// The fastest of this machine.
inline void write_halves(std::span<const float> floats, uint16_t* halves) noexcept {
#ifdef TETRALIGHT_HAS_HIGHWAY
    write_halves_in_vectors(floats, halves);
#else
    write_halves_scalar(floats, halves);
#endif
}

}  // namespace tetralight::detail
