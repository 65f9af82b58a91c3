// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/sphere_mesh.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace tetralight {
namespace {

Mesh make_icosahedron() {
    constexpr float kGolden = 1.6180340f;
    Mesh mesh;
    // Corners of three golden rectangles, 0 to 3 in the plane x = 0 and so on.
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 4; ++i) {
            glm::vec3 corner(0.0f);
            corner[(axis + 1) % 3] = i % 2 == 0 ? 1.0f : -1.0f;
            corner[(axis + 2) % 3] = i / 2 == 0 ? kGolden : -kGolden;
            mesh.positions.push_back(glm::normalize(corner));
        }
    }
    // The faces are the triples of mutually nearest corners.
    constexpr float kEdge = 1.06f;
    const auto are_near = [&](uint32_t a, uint32_t b) {
        return glm::distance(mesh.positions[a], mesh.positions[b]) < kEdge;
    };
    for (uint32_t a = 0; a < 12; ++a) {
        for (uint32_t b = a + 1; b < 12; ++b) {
            for (uint32_t c = b + 1; c < 12; ++c) {
                if (!are_near(a, b) || !are_near(b, c) || !are_near(c, a)) continue;
                const glm::vec3 p = mesh.positions[a];
                const glm::vec3 normal = glm::cross(mesh.positions[b] - p, mesh.positions[c] - p);
                const bool is_outward = glm::dot(normal, p) > 0.0f;
                mesh.indices.insert(mesh.indices.end(),
                                    {a, is_outward ? b : c, is_outward ? c : b});
            }
        }
    }
    return mesh;
}

/// Splits each triangle into four.
void subdivide(Mesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> midpoints;
    const auto midpoint = [&](uint32_t a, uint32_t b) {
        const auto [found, is_new] =
            midpoints.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.positions.size()));
        if (is_new) {
            mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
        }
        return found->second;
    };
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
        indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.indices = std::move(indices);
}

}  // namespace

Mesh make_sphere_mesh(uint32_t subdivisions) {
    Mesh mesh = make_icosahedron();
    for (uint32_t i = 0; i < subdivisions; ++i) subdivide(mesh);
    mesh.normals = mesh.positions;
    return mesh;
}

}  // namespace tetralight
