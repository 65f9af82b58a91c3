// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// The shape that a transform gives to a mesh, without its rotation, reflection, position and
/// size.
struct MeshShape {
    /// Mᵀ M / size² of the linear part M, upper triangle, in steps of 2^-16.
    std::array<int64_t, 6> metric{};

    auto operator<=>(const MeshShape&) const = default;
};

/// A transform as shape and size.
struct ShapedTransform {
    MeshShape shape;
    /// √(trace(Mᵀ M) / 3): the scale, if it is uniform.
    double size = 1.0;
};

[[nodiscard]] ShapedTransform shape_of(const MeshInstance& instance);

/// The positions of a mesh in its shape: distances times the size are those in the world.
[[nodiscard]] std::vector<glm::vec3> shaped_positions(std::span<const glm::vec3> positions,
                                                      const MeshShape& shape);

}  // namespace tetralight
