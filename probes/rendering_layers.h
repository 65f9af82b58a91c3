// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Rendering layers keep light apart that shares a place: of rooms, of two sides of a thin wall, of
// what a level switches. Groups of probes and objects are on any of 32 of them, as the bits of a
// mask.

namespace tetralight {

inline constexpr uint32_t kRenderingLayerCount = 32;

inline constexpr uint32_t kAllRenderingLayers = 0xffffffff;

}  // namespace tetralight
