// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace tetralight {

/// Khronos PBR Neutral tone mapper (Khronos Group 2024, specification of that name): linear
/// radiance × exposure in, linear display values in [0, 1] out. Colors below 0.76 keep their hue
/// and value except for a small toe; brighter colors are compressed towards white.
[[nodiscard]] glm::vec3 tone_map_neutral(glm::vec3 color) noexcept;

}  // namespace tetralight
