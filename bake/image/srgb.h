// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace tetralight {

/// Linear value of an sRGB-encoded one in [0, 1] by the exact piecewise curve (IEC 61966-2-1).
[[nodiscard]] float linear_from_srgb(float encoded) noexcept;

/// The same for an 8-bit code, by table.
[[nodiscard]] float linear_from_srgb8(uint8_t code) noexcept;

/// The linear values of all 8-bit codes.
[[nodiscard]] const std::array<float, 256>& linear_from_srgb8_codes() noexcept;

/// Inverse of `linear_from_srgb`; the argument is clamped to [0, 1] first.
[[nodiscard]] float srgb_from_linear(float linear) noexcept;

/// Nearest 8-bit sRGB code of a linear value.
[[nodiscard]] uint8_t srgb8_from_linear(float linear) noexcept;

}  // namespace tetralight
