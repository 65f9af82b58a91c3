// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/vector_volumes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>
#include "tests/conformance/numbers.h"
#include "tests/conformance/vector_walls.h"

namespace tetralight::conformance {
namespace {

using Positions = std::vector<glm::dvec3>;

Positions random_positions(size_t count, double half_side, Numbers& numbers) {
    Positions positions;
    for (size_t i = 0; i < count; ++i) positions.push_back(numbers.in_cube(half_side));
    return positions;
}

IrradianceSh random_light(Numbers& numbers) {
    IrradianceSh sh;
    for (size_t i = 0; i < sh.coefficients.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double value = i == 0 ? numbers.between(1, 4) : numbers.between(-0.75, 0.75);
            sh.coefficients[i][channel] = static_cast<float>(value);
        }
    }
    return sh;
}

/// Light of each probe, and ambient light.
void light_probes(ProbeVolume& volume, Numbers& numbers) {
    volume.info.ambient = random_light(numbers);
    volume.irradiance.clear();
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.irradiance.push_back(random_light(numbers));
    }
}

void add_occlusion(ProbeVolume& volume, Numbers& numbers) {
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        glm::vec4 occlusion(0.0f);
        for (int k = 0; k < 4; ++k) occlusion[k] = static_cast<float>(numbers.between(0, 1));
        volume.occlusion.push_back(occlusion);
    }
}

/// Merged as they are: not welded, and not moved onto lattices.
ProbeVolume volume_of(Positions positions) {
    MergedProbes merged;
    for (uint32_t i = 0; i < positions.size(); ++i) merged.sources.push_back({0, i, i});
    merged.positions = std::move(positions);
    merged.group_names = {"probes"};
    merged.group_rendering_layers = {kAllRenderingLayers};
    return make_probe_volume(merged);
}

ProbeVolume lit_volume_of(Positions positions, Numbers& numbers) {
    ProbeVolume volume = volume_of(std::move(positions));
    light_probes(volume, numbers);
    return volume;
}

ProbeVolume make_empty() {
    Numbers numbers(1);
    ProbeVolume volume;
    volume.info.ambient = random_light(numbers);
    return volume;
}

ProbeVolume make_point() {
    Numbers numbers(2);
    ProbeVolume volume = lit_volume_of({{1.5, -2.0, 0.25}}, numbers);
    add_occlusion(volume, numbers);
    make_compact_probes(volume);
    return volume;
}

/// Multiples of one vector, so that they lie on one line exactly.
ProbeVolume make_line() {
    Numbers numbers(3);
    Positions positions;
    for (const double t : {-3.0, -1.0, -0.5, 1.0, 4.0}) {
        positions.push_back(glm::dvec3(1, 2, 3) + t * glm::dvec3(2, -1, 0.5));
    }
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    add_random_walls(volume, numbers);
    make_compact_probes(volume);
    volume.seed_grid.clear();
    make_seeds(volume);
    return volume;
}

/// Integer multiples of two vectors: exactly in one plane.
ProbeVolume make_plane() {
    Numbers numbers(4);
    Positions positions;
    for (const auto& [u, v] : std::array<std::pair<int, int>, 10>{{{0, 0},
                                                                   {4, 1},
                                                                   {1, 4},
                                                                   {-3, 2},
                                                                   {-1, -4},
                                                                   {3, -3},
                                                                   {1, 1},
                                                                   {-2, -1},
                                                                   {6, 5},
                                                                   {2, 2}}}) {
        positions.push_back(glm::dvec3(-4, 1, 0) + double(u) * glm::dvec3(1, 0.5, 0) +
                            double(v) * glm::dvec3(0, 0.25, 1));
    }
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    add_occlusion(volume, numbers);
    add_random_walls(volume, numbers);
    return volume;
}

ProbeVolume make_space() {
    Numbers numbers(5);
    Positions positions = random_positions(16, 2.0, numbers);
    return lit_volume_of(std::move(positions), numbers);
}

Positions lattice(int nx, int ny, int nz, double step) {
    Positions positions;
    for (int i = 0; i < nx * ny * nz; ++i) {
        positions.push_back(step * glm::dvec3(i % nx, i / nx % ny, i / nx / ny));
    }
    return positions;
}

/// Planes x = 2.6 and z = 1.2 divide a lattice into four rooms.
ProbeVolume make_walls() {
    Numbers numbers(6);
    ProbeVolume volume = lit_volume_of(lattice(3, 2, 3, 2.0), numbers);
    const std::array<WallPlane, 2> walls{{{{1, 0, 0}, 2.6}, {{0, 0, 1}, 1.2}}};
    add_walls(volume, walls);
    for (const glm::vec3& p : volume.positions) {
        volume.rendering_layers.push_back(p.x < 1.0f ? 1u : p.x < 3.0f ? 3u : 6u);
    }
    return volume;
}

ProbeVolume make_random_walls() {
    Numbers numbers(7);
    Positions positions = random_positions(10, 3.0, numbers);
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    add_random_walls(volume, numbers);
    return volume;
}

/// The corners of cubes are moved by less than a step of their floats: exact predicates join four
/// of them to tetrahedra whose stored positions lie in a plane.
ProbeVolume make_slivers() {
    Numbers numbers(8);
    Positions positions = lattice(3, 3, 2, 1.0);
    for (glm::dvec3& p : positions) p += glm::dvec3(1.0) + numbers.in_cube(1e-9);
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    volume.seed_grid.clear();  // walks begin at cell 0
    return volume;
}

/// The origin is not exactly a float.
ProbeVolume make_far() {
    Numbers numbers(9);
    Positions positions = random_positions(12, 40.0, numbers);
    for (glm::dvec3& p : positions) p += glm::dvec3(3e6, -2e5, 1e5);
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    const glm::dvec3 shift(0.1, -0.3, 1e-5);
    volume.info.world_origin += shift;
    for (glm::dvec3& p : volume.exact_positions) p += shift;
    make_compact_probes(volume);
    volume.irradiance.clear();
    return volume;
}

ProbeVolume make_clusters() {
    Numbers numbers(10);
    Positions positions = random_positions(10, 0.5, numbers);
    for (const glm::dvec3& p : random_positions(10, 0.5, numbers)) {
        positions.push_back(p + glm::dvec3(1000, 300, -200));
    }
    return lit_volume_of(std::move(positions), numbers);
}

ProbeVolume make_layers() {
    Numbers numbers(11);
    Positions positions = random_positions(8, 2.0, numbers);
    ProbeVolume volume = lit_volume_of(std::move(positions), numbers);
    add_occlusion(volume, numbers);
    volume.layer_names = "sun\nlight:lamp\nrest\n";
    for (int k = 0; k < 3; ++k) {
        std::vector<IrradianceSh> light;
        for (size_t i = 0; i < volume.positions.size(); ++i) light.push_back(random_light(numbers));
        Layer layer;
        layer.ambient = random_light(numbers);
        layer.largest = largest_coefficient(light);
        volume.layers.push_back(layer);
        volume.layer_irradiance.insert(volume.layer_irradiance.end(), light.begin(), light.end());
    }
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.validity.push_back(i % 3 == 0 ? 0.125f : 1.0f);
        volume.health.push_back({0.01f, 0.5f, glm::vec3(0.0f), i % 3 == 0 ? 1u : 0u});
    }
    make_compact_probes(volume);
    const std::array<float, 3> weights{1.0f, 0.5f, 2.0f};
    const Status status = recombine(volume, weights);
    TETRALIGHT_ASSERT(static_cast<bool>(status), "the weights are right");
    return volume;
}

ProbeVolume make_unbaked() {
    Numbers numbers(12);
    ProbeVolume volume = volume_of(random_positions(5, 1.0, numbers));
    volume.info.ambient = random_light(numbers);
    return volume;
}

}  // namespace

std::vector<VectorVolume> make_vector_volumes() {
    return {
        {"empty", "no probes", make_empty()},
        {"point", "a single probe, in half precision", make_point()},
        {"line", "probes on a line, walls, half precision, seeds", make_line()},
        {"plane", "probes in a tilted plane, walls, occlusion", make_plane()},
        {"space", "random probes", make_space()},
        {"walls", "two walls that meet, rendering layers", make_walls()},
        {"random_walls", "random codes and splits", make_random_walls()},
        {"slivers", "tetrahedra without volume, no seed grid", make_slivers()},
        {"far", "far from the origin of the world, half precision only", make_far()},
        {"clusters", "two clusters a kilometre apart", make_clusters()},
        {"layers", "layers of light, invalid probes, occlusion, half precision", make_layers()},
        {"unbaked", "cells without light", make_unbaked()},
    };
}

float largest_light(const ProbeVolumeView& volume) {
    float largest = largest_coefficient(std::span(&volume.info.ambient, 1));
    for (const CompactProbe& probe : volume.compact) {
        const IrradianceSh sh = compact_irradiance(probe, volume.info.compact_scale);
        largest = std::max(largest, largest_coefficient(std::span(&sh, 1)));
    }
    return std::max({largest, largest_coefficient(volume.irradiance),
                     largest_coefficient(volume.layer_irradiance)});
}

}  // namespace tetralight::conformance
