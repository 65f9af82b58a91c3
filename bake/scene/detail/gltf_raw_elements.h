// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

// Elements of accessors as the bytes that the file has, to copy them without rounding.

namespace tetralight::detail {

/// Tightly packed elements.
struct RawElements {
    std::vector<std::byte> bytes;
    size_t count = 0;
    size_t element_size = 0;
    uint32_t component_type = 0;
    uint32_t component_count = 0;
};

/// All elements of an accessor of any component type, sparse ones included. Returns unsupported for
/// matrices; corrupt if they lie outside of their buffer view.
[[nodiscard]] Result<RawElements> read_raw_elements(const GltfDocument& document,
                                                    uint32_t accessor_index);

/// The elements at these indices, which are in range.
[[nodiscard]] RawElements gather_elements(const RawElements& elements,
                                          std::span<const uint32_t> indices);

/// Smallest and largest value of each component, not normalized, as `min` and `max` of an accessor.
struct RawBounds {
    std::vector<double> min;
    std::vector<double> max;
};

/// Precondition: there are elements.
[[nodiscard]] RawBounds raw_bounds(const RawElements& elements);

}  // namespace tetralight::detail
