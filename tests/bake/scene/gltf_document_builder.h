// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>

namespace tetralight {

/// Appends an accessor with a buffer of its own; returns its index.
template <class T>
uint32_t add_elements(detail::GltfDocument& document, const std::vector<T>& values,
                      uint32_t component_type, uint32_t component_count) {
    const auto buffer = static_cast<uint32_t>(document.buffers.size());
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    document.buffer_views.push_back({buffer, 0, bytes.size(), 0, std::nullopt});
    document.buffers.push_back(std::move(bytes));
    const auto view = static_cast<uint32_t>(document.buffer_views.size() - 1);
    document.accessors.push_back({view, 0, component_type, component_count, false,
                                  values.size() / component_count, std::nullopt});
    return static_cast<uint32_t>(document.accessors.size() - 1);
}

inline uint32_t add_floats(detail::GltfDocument& document, const std::vector<float>& values,
                           uint32_t component_count) {
    return add_elements(document, values, 5126, component_count);
}

}  // namespace tetralight
