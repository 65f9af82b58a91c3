// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// Irradiance / π as the seven float4 that shaders evaluate with dot products (the packing that
/// Ramamoorthi & Hanrahan's polynomial allows, see docs/conventions.md):
///
///     E(n)/π = dot(sha, (n, 1)) + dot(shb, (xy, yz, zz, zx)) + shc · (x² − y²)
struct PackedSh {
    glm::vec4 sha_r, sha_g, sha_b;
    glm::vec4 shb_r, shb_g, shb_b;
    glm::vec4 shc;

    bool operator==(const PackedSh&) const = default;
};

static_assert(sizeof(PackedSh) == 112 && std::is_trivially_copyable_v<PackedSh>);

[[nodiscard]] PackedSh pack_sh(const IrradianceSh& irradiance) noexcept;

/// Irradiance / π at a unit normal: times albedo it is the diffuse exitant radiance. Can be
/// negative where the light rings.
[[nodiscard]] glm::vec3 sample_sh9(const PackedSh& sh, glm::vec3 normal) noexcept;

}  // namespace tetralight
