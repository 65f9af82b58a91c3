// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

#include "tests/support/scenes.h"

// Closed curved meshes whose insides have a formula.

namespace tetralight::test {

/// A grid of (rows + 1) × (columns + 1) places of a surface, u and v in [0, 1], joined by
/// triangles. The front is where ∂u × ∂v points to.
template <class Surface>
Mesh surface_mesh(int rows, int columns, Surface position) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            mesh.positions.push_back(
                position(static_cast<double>(row) / rows, static_cast<double>(column) / columns));
        }
    }
    const auto at = [&](int row, int column) {
        return static_cast<uint32_t>(row * (columns + 1) + column);
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const uint32_t a = at(row, column), b = at(row + 1, column);
            const uint32_t c = at(row + 1, column + 1), d = at(row, column + 1);
            for (const uint32_t corner : {a, b, c, a, c, d}) mesh.indices.push_back(corner);
        }
    }
    return mesh;
}

/// A ball around the origin that faces out.
inline Mesh sphere_mesh(double radius, int rows = 100) {
    return surface_mesh(rows, 2 * rows, [=](double u, double v) {
        const double polar = std::numbers::pi * u, azimuth = 2.0 * std::numbers::pi * v;
        return glm::vec3(radius * std::sin(polar) * std::sin(azimuth), radius * std::cos(polar),
                         radius * std::sin(polar) * std::cos(azimuth));
    });
}

/// A ring around the Y axis that faces out.
inline Mesh torus_mesh(double ring_radius, double tube_radius, int rows = 100) {
    return surface_mesh(rows, 2 * rows, [=](double u, double v) {
        const double polar = -2.0 * std::numbers::pi * u, azimuth = 2.0 * std::numbers::pi * v;
        const double radius = ring_radius + tube_radius * std::cos(polar);
        return glm::vec3(radius * std::sin(azimuth), tube_radius * std::sin(polar),
                         radius * std::cos(azimuth));
    });
}

inline bool is_in_torus(const glm::dvec3& p, double ring_radius, double tube_radius) {
    return std::hypot(std::hypot(p.x, p.z) - ring_radius, p.y) < tube_radius;
}

}  // namespace tetralight::test
