// SPDX-License-Identifier: Apache-2.0
// Positions that the baker considers inside closed meshes, against the winding number.
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/closed_solids.h>

namespace tetralight::bench {
namespace {

constexpr size_t kPositions = 4000;
constexpr int kRows = 32, kColumns = 64;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// A surface over two angles; its front faces along ∂polar × ∂azimuth.
using AngleSurface = std::function<glm::dvec3(double polar, double azimuth)>;

glm::dvec3 on_sphere(double polar, double azimuth) {
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar),
            std::sin(polar) * std::cos(azimuth)};
}

glm::dvec3 ball(double polar, double azimuth) {
    return 1.5 * on_sphere(0.5 * polar, azimuth);
}

/// A shape with bulges and dents, some of them narrow.
glm::dvec3 star(double polar, double azimuth) {
    const double radius =
        1.2 + 0.5 * std::sin(1.5 * polar) * std::sin(5.0 * azimuth) + 0.2 * std::cos(3.0 * polar);
    return radius * on_sphere(0.5 * polar, azimuth);
}

glm::dvec3 ring(double polar, double azimuth) {
    const double radius = 1.2 + 0.6 * std::cos(polar);
    return {radius * std::sin(azimuth), -0.6 * std::sin(polar), radius * std::cos(azimuth)};
}

Mesh mesh_of(const AngleSurface& surface) {
    Mesh mesh;
    for (int i = 0; i < (kRows + 1) * (kColumns + 1); ++i) {
        // The last column is bit-identical to the first.
        const int row = i / (kColumns + 1), column = i % (kColumns + 1) % kColumns;
        mesh.positions.emplace_back(surface(kTurn * row / kRows, kTurn * column / kColumns));
    }
    for (int i = 0; i < kRows * kColumns; ++i) {
        const auto a = static_cast<uint32_t>(i / kColumns * (kColumns + 1) + i % kColumns);
        const uint32_t b = a + kColumns + 1;
        for (const uint32_t corner : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(corner);
    }
    return mesh;
}

/// Solid angles of all triangles over 4π: whole numbers, 0 = outside.
double winding_number(const Mesh& mesh, const glm::dvec3& position) {
    double angle = 0.0;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto corner = [&](size_t k) {
            return glm::dvec3(mesh.positions[mesh.indices[i + k]]);
        };
        angle += solid_angle({corner(0), corner(1), corner(2)}, position);
    }
    return angle / (2.0 * kTurn);
}

void measure(const std::string& name, const AngleSurface& surface) {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {mesh_of(surface)};
    scene.meshes[0].material = 0;
    scene.instances.resize(1);
    scene.instances[0].mesh = 0;
    std::vector<glm::dvec3> positions = random_positions(kPositions, 3, 3.8);
    for (glm::dvec3& position : positions) position -= 1.9;
    const auto visibility = probe_visibilities(scene, positions);
    require(bool(visibility), "survey");
    size_t agreeing = 0, inside = 0;
    for (size_t i = 0; i < kPositions; ++i) {
        const bool is_inside = winding_number(scene.meshes[0], positions[i]) > 0.5;
        agreeing += (*visibility)[i].is_inside() == is_inside;
        inside += is_inside;
    }
    require(inside > kPositions / 20, "positions inside " + name);
    report("bake.validity." + name, 100.0 * static_cast<double>(agreeing) / kPositions,
           "% as exact");
}

}  // namespace

void bench_bake_validity() {
    measure("ball", ball);
    measure("ring", ring);
    measure("star", star);
}

}  // namespace tetralight::bench
