// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

// Reads accessors into plain arrays: floats unchanged, 8- and 16-bit integers as
// KHR_mesh_quantization defines them (normalized or not). Errors name the accessor.

namespace tetralight::detail {

/// Elements of an accessor without a buffer view, which are zeros: limited, so that a small file
/// cannot fill memory.
inline constexpr uint64_t kMaxZeroElements = 1 << 20;

[[nodiscard]] Result<std::vector<float>> read_scalars(const GltfDocument& document,
                                                      uint32_t accessor_index);
[[nodiscard]] Result<std::vector<glm::vec2>> read_vec2s(const GltfDocument& document,
                                                        uint32_t accessor_index);
[[nodiscard]] Result<std::vector<glm::vec3>> read_vec3s(const GltfDocument& document,
                                                        uint32_t accessor_index);
[[nodiscard]] Result<std::vector<glm::vec4>> read_vec4s(const GltfDocument& document,
                                                        uint32_t accessor_index);
[[nodiscard]] Result<std::vector<glm::mat4>> read_mat4s(const GltfDocument& document,
                                                        uint32_t accessor_index);

/// Colours of vertices, RGB (alpha is 1 then) or RGBA, none below 0.
[[nodiscard]] Result<std::vector<glm::vec4>> read_colors(const GltfDocument& document,
                                                         uint32_t accessor_index);

/// Unsigned integers of 8, 16 or 32 bits.
[[nodiscard]] Result<std::vector<uint32_t>> read_indices(const GltfDocument& document,
                                                         uint32_t accessor_index);

}  // namespace tetralight::detail
