// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Cube maps: six square faces in the order +X, -X, +Y, -Y, +Z, -Z. Rows and columns of a face are
// those of OpenGL, Vulkan and KTX 2.0 (OpenGL 4.6 specification, table 8.19): a shader samples the
// cube with a direction in world axes as it is.

namespace tetralight {

inline constexpr uint32_t kCubeFaceCount = 6;

/// A place on a cube. `uv` in [0, 1]²: the center of texel (x, y) of a face of n texels is at
/// ((x + ½) / n, (y + ½) / n).
struct CubePlace {
    uint32_t face = 0;
    glm::vec2 uv{0.0f};
};

struct CubeTexel {
    uint32_t face = 0, x = 0, y = 0;

    bool operator==(const CubeTexel&) const = default;
};

/// The unit direction from the center of a cube to a place. `uv` may lie beyond the face.
[[nodiscard]] glm::vec3 cube_direction(const CubePlace& place) noexcept;

/// The direction to the center of a texel of a face of `size` texels.
[[nodiscard]] glm::vec3 cube_direction(const CubeTexel& texel, uint32_t size) noexcept;

/// The inverse of `cube_direction`. A direction of any length; zero gives a corner of face +X.
[[nodiscard]] CubePlace cube_place(glm::vec3 direction) noexcept;

/// Solid angle of texel (x, y) of any face, steradians: those of a cube add up to 4π. By the
/// antiderivative atan2(uv, sqrt(u² + v² + 1)).
[[nodiscard]] double cube_solid_angle(uint32_t x, uint32_t y, uint32_t size) noexcept;

/// A texel of a face or, if x or y is -1 or `size`, the texel across that edge. Beyond a corner it
/// is one of the two texels beside the corner.
[[nodiscard]] CubeTexel wrapped_texel(uint32_t face, int x, int y, uint32_t size) noexcept;

}  // namespace tetralight
