// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/probes/sh.h>

namespace tetralight::test {

/// The `probe_data` of a text resource, read from its text alone.
struct GodotProbes {
    glm::dvec3 low{0.0};
    glm::dvec3 size{0.0};
    std::vector<double> points;      ///< 3 a probe
    std::vector<double> sh;          ///< 36 a probe
    std::vector<double> tetrahedra;  ///< 4 a tetrahedron
    std::vector<double> bsp;         ///< 6 a node
    std::string interior;
    std::string baked_exposure;

    explicit GodotProbes(const std::string& resource);

    /// Irradiance ÷ π, as Godot's shader has it, at a position of the resource. Planes are in
    /// floats as in Godot, weights in doubles.
    [[nodiscard]] std::array<double, 3> light(glm::vec3 position, glm::vec3 normal) const;

    /// The tetrahedron where the walk ends; −1 if it does not end, or at something else.
    [[nodiscard]] int64_t find(glm::vec3 position) const;
};

}  // namespace tetralight::test
