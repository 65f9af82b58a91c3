// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include <tetralight/probes/packed_sh.h>

// The functions of runtime/shaders/sh.glsl in C++, with the same names without `tetralight_`.
// `sample_sh9` is in probes/packed_sh.h. A test compares both for random inputs.

namespace tetralight {

/// The first two bands of `PackedSh`: E(n)/π ≈ dot(sha, (n, 1)) for red, green and blue.
struct PackedSh4 {
    glm::vec4 sha_r, sha_g, sha_b;

    bool operator==(const PackedSh4&) const = default;
};

static_assert(sizeof(PackedSh4) == 48 && std::is_trivially_copyable_v<PackedSh4>);

/// The first two bands of packed light. sha.w of `PackedSh` includes the constant part of 3z² − 1
/// of the third band; this function removes it.
[[nodiscard]] PackedSh4 first_bands(const PackedSh& sh) noexcept;

/// Irradiance / π of two bands at a unit normal.
[[nodiscard]] glm::vec3 sample_sh4(const PackedSh4& sh, glm::vec3 normal) noexcept;

/// Adds one layer of light times its weight for red, green and blue.
[[nodiscard]] PackedSh add_layer(const PackedSh& sum, const PackedSh& layer,
                                 glm::vec3 weight) noexcept;

/// Visibility of a light at an object, 1 = lit: the light's channel (0..3) of the probes'
/// occlusion. 1 for any other channel.
[[nodiscard]] float probe_occlusion(const glm::vec4& occlusion, int channel) noexcept;

/// The shadow of a light with a limited shadow map: `shadow` (1 = lit) from the map, `occlusion`
/// from the probes, `fade` 0 inside the range of the map and 1 outside.
[[nodiscard]] float mix_occlusion(float shadow, float occlusion, float fade) noexcept;

/// World-space unit normal of an instance whose transform has these axes (the first three columns
/// of world_from_instance), for scales between 1e-9 and 1e9, also mirrored. A singular transform
/// returns the normal unchanged.
[[nodiscard]] glm::vec3 instance_normal(glm::vec3 x_axis, glm::vec3 y_axis, glm::vec3 z_axis,
                                        glm::vec3 normal) noexcept;

/// The direction of most light: that of the second band.
[[nodiscard]] glm::vec3 dominant_direction(const PackedSh& sh) noexcept;

/// Irradiance of the directional light in this direction that has this second band, on a surface
/// that faces it. It approximates the light that a glossy surface reflects.
[[nodiscard]] glm::vec3 dominant_irradiance(const PackedSh& sh, glm::vec3 direction) noexcept;

/// Specular radiance of a light for each unit of its irradiance on a surface that faces it: GGX
/// (Walter et al. 2007) with Smith's masking (Heitz 2014) and Schlick's Fresnel term, glTF's
/// roughness, all directions of length 1.
[[nodiscard]] glm::vec3 specular_reflection(glm::vec3 normal, glm::vec3 to_light, glm::vec3 to_eye,
                                            glm::vec3 f0, float roughness) noexcept;

}  // namespace tetralight
