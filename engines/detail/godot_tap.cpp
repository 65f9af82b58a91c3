// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/godot_tap.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace tetralight::detail {
namespace {

/// Volumes of the tetrahedra that the position makes with each face, ÷ that of the tetrahedron.
glm::vec4 weights(const std::array<glm::vec3, 4>& corners, glm::vec3 position) {
    const auto& [a, b, c, d] = corners;
    const auto triple = [](glm::vec3 u, glm::vec3 v, glm::vec3 w) {
        return glm::dot(u, glm::cross(v, w));
    };
    const glm::vec3 from_a = position - a;
    const glm::vec3 from_b = position - b;
    const float scale = 1.0f / triple(b - a, c - a, d - a);
    return scale * glm::vec4(triple(from_b, d - b, c - b), triple(from_a, c - a, d - a),
                             triple(from_a, d - a, b - a), triple(from_a, b - a, c - a));
}

}  // namespace

IrradianceSh tap_godot_light(const BoxedCells& cells, const BspTree& tree, glm::vec3 position) {
    const auto& vertices = cells.tetrahedra[find_tetrahedron(tree.nodes, position)];
    std::array<glm::vec3, 4> corners;
    for (size_t i = 0; i < 4; ++i) corners[i] = cells.positions[vertices[i]];
    const glm::vec4 shares = glm::clamp(weights(corners, position), 0.0f, 1.0f);
    IrradianceSh light;
    for (size_t i = 0; i < 4; ++i) {
        light = light + cells.light[vertices[i]] * shares[static_cast<int>(i)];
    }
    return light;
}

}  // namespace tetralight::detail
