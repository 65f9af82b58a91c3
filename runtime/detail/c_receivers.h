// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/runtime/detail/c_arrays.h>

// What is lit, as C callers say it: the last members of their batches.

namespace tetralight::detail {

[[nodiscard]] CallError check_walls(uint32_t walls);

/// Layers may be any; radii must be finite and not negative.
[[nodiscard]] CallError check_receivers(const tetralight_const_array& rendering_layers,
                                        const tetralight_const_array& radii, size_t count);

[[nodiscard]] CallError check_normals(const tetralight_const_array& normals, float normal_offset,
                                      size_t count);

/// Elements [begin, begin + count) of a checked array without gaps; empty if it is NULL.
template <class Element>
[[nodiscard]] std::span<const Element> elements_of(const tetralight_const_array& array,
                                                   size_t begin, size_t count) {
    if (!array.data) return {};
    return {static_cast<const Element*>(array.data) + begin, count};
}

}  // namespace tetralight::detail
