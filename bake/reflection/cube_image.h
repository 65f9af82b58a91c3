// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/probes/sh.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {

/// Radiance in all directions from a place: the texels of the faces of a cube (reflection/cube.h),
/// face after face, row after row.
struct CubeImage {
    uint32_t size = 0;  ///< texels along a side of a face
    std::vector<glm::vec3> texels;

    [[nodiscard]] size_t index(const CubeTexel& texel) const {
        return (size_t{texel.face} * size + texel.y) * size + texel.x;
    }

    /// The texel of an index.
    [[nodiscard]] CubeTexel texel(size_t index) const {
        const size_t row = index / size;
        return {static_cast<uint32_t>(row / size), static_cast<uint32_t>(index % size),
                static_cast<uint32_t>(row % size)};
    }

    bool operator==(const CubeImage&) const = default;
};

/// Texels of a cube with faces of `size` texels.
[[nodiscard]] constexpr size_t cube_texel_count(uint32_t size) {
    return size_t{kCubeFaceCount} * size * size;
}

/// The light as spherical harmonics, with the solid angles of the texels.
[[nodiscard]] RadianceSh project_cube(const CubeImage& cube);

}  // namespace tetralight
