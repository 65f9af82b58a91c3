// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/detail/closest_point.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace tetralight::detail {
namespace {

glm::dvec3 closest_on_edge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    const double length2 = glm::dot(edge, edge);
    if (!(length2 > 0.0)) return a;
    return a + std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) * edge;
}

}  // namespace

glm::vec3 closest_point(glm::vec3 position, const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 p(position), a(triangle[0]), b(triangle[1]), c(triangle[2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    // Over the triangle: on the inner side of all three edges.
    if (glm::dot(glm::cross(b - a, p - a), normal) > 0.0 &&
        glm::dot(glm::cross(c - b, p - b), normal) > 0.0 &&
        glm::dot(glm::cross(a - c, p - c), normal) > 0.0) {
        return glm::vec3(p - normal * (glm::dot(p - a, normal) / glm::dot(normal, normal)));
    }
    glm::dvec3 nearest = closest_on_edge(p, a, b);
    for (const glm::dvec3& other : {closest_on_edge(p, b, c), closest_on_edge(p, c, a)}) {
        if (glm::distance(p, other) < glm::distance(p, nearest)) nearest = other;
    }
    return glm::vec3(nearest);
}

}  // namespace tetralight::detail
