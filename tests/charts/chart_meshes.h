// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <vector>

#include <tetralight/charts/unwrap.h>

namespace tetralight {

/// A mesh that a test unwraps.
struct OwnedMesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;

    [[nodiscard]] ChartMesh view() const { return {positions, indices}; }

    [[nodiscard]] size_t triangle_count() const { return indices.size() / 3; }

    [[nodiscard]] glm::dvec3 corner(size_t triangle, size_t k) const {
        return glm::dvec3(positions[indices[3 * triangle + k]]);
    }

    [[nodiscard]] double area(size_t triangle) const {
        const glm::dvec3 a = corner(triangle, 0);
        return 0.5 * glm::length(glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a));
    }

    void add_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        for (const glm::vec3 p : {a, b, c}) {
            indices.push_back(static_cast<uint32_t>(positions.size()));
            positions.push_back(p);
        }
    }

    /// abcd counterclockwise seen from the front.
    void add_quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        add_triangle(a, b, c);
        add_triangle(a, c, d);
    }
};

/// The image of the unit square, in columns × rows quads; at(u, v) gives a position.
template <class At>
[[nodiscard]] OwnedMesh mesh_of_surface(uint32_t columns, uint32_t rows, At&& at) {
    OwnedMesh mesh;
    const auto corner = [&](uint32_t i, uint32_t j) {
        return glm::vec3(at(double(i) / columns, double(j) / rows));
    };
    for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            mesh.add_quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
    }
    return mesh;
}

/// A plane of z = 0, one corner at the origin.
[[nodiscard]] inline OwnedMesh plane_mesh(glm::dvec2 size, uint32_t columns, uint32_t rows) {
    return mesh_of_surface(
        columns, rows, [&](double u, double v) { return glm::dvec3(size.x * u, size.y * v, 0.0); });
}

/// A box between two corners, seen from outside.
[[nodiscard]] inline OwnedMesh box_mesh(glm::vec3 a, glm::vec3 b) {
    OwnedMesh mesh;
    mesh.add_quad({a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z});
    mesh.add_quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
    mesh.add_quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
    mesh.add_quad({a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z});
    mesh.add_quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
    mesh.add_quad({b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z});
    return mesh;
}

/// A sphere of radius 1; the triangles at its poles have no area.
[[nodiscard]] inline OwnedMesh sphere_mesh(uint32_t columns, uint32_t rows) {
    return mesh_of_surface(columns, rows, [](double u, double v) {
        const double longitude = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0);
        const double radius = v > 0.0 && v < 1.0 ? std::sin(std::numbers::pi * v) : 0.0;
        return glm::dvec3(radius * std::cos(longitude), radius * std::sin(longitude),
                          -std::cos(std::numbers::pi * v));
    });
}

/// A cylinder of radius 1 without its ends.
[[nodiscard]] inline OwnedMesh cylinder_mesh(double height, uint32_t columns, uint32_t rows) {
    return mesh_of_surface(columns, rows, [&](double u, double v) {
        const double angle = 2.0 * std::numbers::pi * (u < 1.0 ? u : 0.0);
        return glm::dvec3(std::cos(angle), std::sin(angle), height * v);
    });
}

/// A ramp about the z axis, between the radii 1 and 2, that climbs by `climb` a turn.
[[nodiscard]] inline OwnedMesh spiral_mesh(double turns, double climb, uint32_t columns) {
    return mesh_of_surface(1, columns, [&](double u, double v) {
        const double angle = 2.0 * std::numbers::pi * turns * v;
        const double radius = 1.0 + u;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), climb * turns * v);
    });
}

/// Triangles between random ones of some random points: many share edges, none has a good shape.
[[nodiscard]] inline OwnedMesh random_triangles(uint32_t seed, uint32_t points, uint32_t count) {
    std::mt19937 random(seed);
    const auto next = [&] { return static_cast<float>(random() % 1024) / 256.0f; };
    OwnedMesh mesh;
    for (uint32_t i = 0; i < points; ++i) {
        const float x = next(), y = next();
        mesh.positions.push_back({x, y, next()});
    }
    for (uint32_t i = 0; i < 3 * count; ++i) {
        mesh.indices.push_back(static_cast<uint32_t>(random() % points));
    }
    return mesh;
}

}  // namespace tetralight
