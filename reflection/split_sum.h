// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// Scale and bias of F0 in the reflectance of a GGX surface under constant light (Karis 2013, "Real
/// Shading in Unreal Engine 4", equation 8), with height-correlated Smith masking, as glTF 2.0
/// (appendix B) has it. `n_dot_v` and `roughness` in [0, 1].
[[nodiscard]] glm::vec2 integrate_split_sum(float n_dot_v, float roughness,
                                            uint32_t sample_count) noexcept;

/// The same for all surfaces: `size` × `size` values at the centers of texels, n · v along a row,
/// roughness from row to row. For a texture with two channels and the linear filter.
[[nodiscard]] std::vector<glm::vec2> make_split_sum_table(uint32_t size = 32,
                                                          uint32_t sample_count = 256);

/// Bilinear, clamped at the edges.
[[nodiscard]] glm::vec2 sample_split_sum(const std::vector<glm::vec2>& table, float n_dot_v,
                                         float roughness) noexcept;

/// Reflectance at normal incidence: 0.04 of dielectrics, the base color of metals.
[[nodiscard]] glm::vec3 specular_f0(glm::vec3 base_color, float metallic) noexcept;

}  // namespace tetralight
