// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight::detail {

/// A plane of floats; its over side is where dot(normal, position) > distance.
struct CutPlane {
    glm::vec3 normal{0.0f};
    float distance = 0.0f;
};

/// The distance of a point over a plane; 0 within several times the rounding of floats.
[[nodiscard]] double distance_over(const CutPlane& plane, const glm::dvec3& point);

/// A convex polyhedron: what planes left of a tetrahedron.
struct ConvexPart {
    std::vector<glm::dvec3> points;
    /// For each face the number of its points, then their indices, in an order around the face.
    std::vector<uint32_t> faces;
};

[[nodiscard]] ConvexPart convex_part(const std::array<glm::dvec3, 4>& corners);

/// Which side of a plane remains of a part.
enum class Side : uint8_t { Over, Under };

/// The part on one side of the plane, which is between points of the part.
[[nodiscard]] ConvexPart cut(const ConvexPart& part, const CutPlane& plane, Side side);

}  // namespace tetralight::detail
