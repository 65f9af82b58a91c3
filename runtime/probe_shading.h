// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include <tetralight/probes/packed_sh.h>

// The functions of runtime/shaders/sh.glsl in C++, under the same names; `sample_sh9` is in
// probes/packed_sh.h. A test runs both over random inputs.

namespace tetralight {

/// The first two bands of `PackedSh`: E(n)/π ≈ dot(sha, (n, 1)) for red, green and blue.
struct PackedSh4 {
    glm::vec4 sha_r, sha_g, sha_b;

    bool operator==(const PackedSh4&) const = default;
};

static_assert(sizeof(PackedSh4) == 48 && std::is_trivially_copyable_v<PackedSh4>);

/// Leaves the third band out: the constant part of its 3z² − 1, which `PackedSh` keeps in sha.w,
/// goes back.
[[nodiscard]] PackedSh4 first_bands(const PackedSh& sh) noexcept;

/// Irradiance / π of two bands at a unit normal.
[[nodiscard]] glm::vec3 sample_sh4(const PackedSh4& sh, glm::vec3 normal) noexcept;

/// Adds one layer of light times its weight for red, green and blue.
[[nodiscard]] PackedSh add_layer(const PackedSh& sum, const PackedSh& layer,
                                 glm::vec3 weight) noexcept;

/// Share of a light that reaches an object, 1 = lit: the light's channel (0..3) of the probes'
/// occlusion. Any other channel: the light is not occluded.
[[nodiscard]] float probe_occlusion(const glm::vec4& occlusion, int channel) noexcept;

/// The shadow of a light whose shadow map ends: `shadow` (1 = lit) from the map, `occlusion` from
/// the probes, `fade` 0 within the map and 1 beyond it.
[[nodiscard]] float mix_occlusion(float shadow, float occlusion, float fade) noexcept;

/// World-space unit normal of an instance whose transform has these axes (the first three columns
/// of world_from_instance), for any scale between 1e-9 and 1e9, mirrored ones too. An instance
/// without a volume keeps the normal as it is.
[[nodiscard]] glm::vec3 instance_normal(glm::vec3 x_axis, glm::vec3 y_axis, glm::vec3 z_axis,
                                        glm::vec3 normal) noexcept;

/// Towards where most light comes from: the direction of the second band.
[[nodiscard]] glm::vec3 dominant_direction(const PackedSh& sh) noexcept;

/// Irradiance, on a surface that faces it, of the directional light there that has this second
/// band: what stands in for the light that a glossy surface mirrors.
[[nodiscard]] glm::vec3 dominant_irradiance(const PackedSh& sh, glm::vec3 direction) noexcept;

/// Radiance that a glossy surface mirrors of a light, for each unit of its irradiance on a surface
/// that faces it: GGX (Walter et al. 2007) with Smith's masking (Heitz 2014) and Schlick's Fresnel
/// term, glTF's roughness, all directions of length 1.
[[nodiscard]] glm::vec3 specular_reflection(glm::vec3 normal, glm::vec3 to_light, glm::vec3 to_eye,
                                            glm::vec3 f0, float roughness) noexcept;

}  // namespace tetralight
