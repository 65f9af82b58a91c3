// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/runtime/shader_volume.h>
#include "tests/support/property_volume.h"
#include "tests/support/random_walls.h"
#include "tests/support/sized_families.h"

namespace tetralight::test {

/// A set of probes whose cells floats can tell apart.
struct ShaderQueryCase {
    std::string family;
    size_t probe_count = 0;

    friend std::ostream& operator<<(std::ostream& out, const ShaderQueryCase& c) {
        return out << c.family << " of " << c.probe_count;
    }
};

inline std::vector<ShaderQueryCase> shader_query_cases() {
    return {{"random", 2000},   {"lattice", 1728},   {"turned_lattice", 1728},
            {"sphere", 500},    {"plane", 500},      {"line", 100},
            {"few", 1},         {"duplicates", 500}, {"far", 1000},
            {"negative", 1000}, {"tiny", 500},       {"pairs", 500},
            {"needle", 300},    {"nearly_flat", 300}};
}

/// A volume of one case with light and occlusion, and positions in and around it.
struct ShaderQueryVolume {
    ProbeVolume volume;

    explicit ShaderQueryVolume(const ShaderQueryCase& which) {
        const auto families = sized_families();
        const auto family = std::ranges::find(families, which.family, &SizedFamily::name);
        volume = make_random_volume(family->make(which.probe_count, 1), 1);
        std::mt19937_64 engine(2);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.occlusion.emplace_back(share(engine), share(engine), share(engine), 1.0f);
        }
        volume.info.ambient = random_light(engine, 1.0f, 2.0f);
    }

    void add_random_walls() { test::add_random_walls(volume, 6); }

    /// A wall across the x axis between two rooms. An edge i → j meets it after d_i / (d_i - d_j)
    /// of its length, where d are the distances of its probes from the wall.
    void add_wall(double x) {
        const ProbeEdges edges(volume.view());
        std::vector<uint8_t> codes;
        for (uint32_t from = 0; from < volume.positions.size(); ++from) {
            for (const uint32_t to : edges.targets(from)) {
                const double d = volume.exact_positions[from].x - x;
                codes.push_back(encode_edge_ratio((d - (volume.exact_positions[to].x - x)) / d));
            }
        }
        store_visibility(edges, codes, volume);
    }

    /// Uniform in the box of the probes, grown by a fifth of its size and never flat.
    [[nodiscard]] std::vector<glm::vec3> make_positions(size_t count) const {
        glm::dvec3 low = volume.exact_positions[0], high = low;
        for (const glm::dvec3& p : volume.exact_positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const glm::dvec3 size = glm::max(high - low, glm::dvec3(1e-3 * volume.info.extent + 1e-6));
        std::mt19937_64 engine(3);
        std::uniform_real_distribution<double> share(-0.2, 1.2);
        std::vector<glm::vec3> positions;
        for (size_t i = 0; i < count; ++i) {
            const double x = share(engine), y = share(engine), z = share(engine);
            positions.emplace_back(low + size * glm::dvec3(x, y, z));
        }
        return positions;
    }

    /// Local positions, half of them near probes, where a seed grid is fine.
    [[nodiscard]] std::vector<glm::vec3> make_seed_positions(size_t count) const {
        std::mt19937_64 engine(5);
        std::vector<glm::vec3> positions;
        for (const glm::vec3& position : make_positions(count)) {
            const glm::vec3 probe = volume.positions[engine() % volume.positions.size()];
            const glm::vec3 local(glm::dvec3(position) - volume.info.world_origin);
            positions.push_back(engine() % 2 ? local : probe + 1e-5f * local);
        }
        return positions;
    }

    /// Where cells meet: middles between two probes of the volume's cells.
    [[nodiscard]] std::vector<glm::vec3> make_edge_middles(size_t count) const {
        std::mt19937_64 engine(4);
        const auto probe_count = static_cast<size_t>(volume.info.dimension);
        std::vector<glm::vec3> positions;
        for (size_t i = 0; i < count; ++i) {
            const Cell& cell = volume.cells[engine() % volume.info.inner_cell_count];
            const uint32_t a = cell.vertices[engine() % probe_count];
            const uint32_t b = cell.vertices[engine() % probe_count];
            positions.emplace_back(0.5 * (volume.exact_positions[a] + volume.exact_positions[b]));
        }
        return positions;
    }
};

/// What a shader may differ by: floats, of light around 1.
inline constexpr float kShaderTolerance = 2e-3f;

/// The largest difference of two answers.
inline float difference(const PackedProbe& a, const PackedProbe& b) {
    const auto* x = reinterpret_cast<const float*>(&a);
    const auto* y = reinterpret_cast<const float*>(&b);
    float largest = 0.0f;
    for (size_t i = 0; i < sizeof a / sizeof(float); ++i) {
        if (!(std::abs(x[i] - y[i]) <= largest)) largest = std::abs(x[i] - y[i]);
    }
    return largest;
}

/// The difference from what the CPU answers.
inline float difference_from_cpu(const ProbeVolumeView& volume, const glm::vec3& position,
                                 const PackedProbe& probe) {
    const InterpolatedProbe cpu = interpolate(volume, locate(volume, position));
    return difference(probe, {pack_sh(cpu.irradiance), cpu.occlusion});
}

/// Whether a location is the position: its probes' positions, blended, are there. Holds within the
/// hull, for any of the cells that meet at a position.
inline bool is_blend_at(const ProbeVolumeView& volume, const glm::vec3& position,
                        const CellLocation& location) {
    if (location.cell >= volume.cells.size()) return false;
    glm::dvec3 blend = volume.info.world_origin;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[location.cell].vertices[static_cast<size_t>(i)];
        if (location.weights[i] == 0.0f) continue;
        blend += static_cast<double>(location.weights[i]) * glm::dvec3(volume.positions[probe]);
    }
    const double rounding =
        1e-6 * static_cast<double>(volume.info.extent) + 2e-7 * glm::length(glm::dvec3(position));
    return glm::distance(blend, glm::dvec3(position)) <= rounding;
}

/// The same light as the CPU; where cells meet, that of either: cells that are thinner than
/// rounding have another light on each side.
inline void expect_answer_of_a_cell(const ProbeVolumeView& volume, const glm::vec3& position,
                                    const CellLocation& location, const PackedProbe& probe) {
    if (difference_from_cpu(volume, position, probe) <= kShaderTolerance) return;
    EXPECT_TRUE(is_blend_at(volume, position, location) &&
                is_blend_at(volume, position, locate(volume, position)))
        << "at " << position.x << ", " << position.y << ", " << position.z << " in cell "
        << location.cell;
}

inline void expect_cpu_answer(const ProbeVolumeView& volume, const glm::vec3& position,
                              const PackedProbe& probe) {
    EXPECT_LE(difference_from_cpu(volume, position, probe), kShaderTolerance)
        << "at " << position.x << ", " << position.y << ", " << position.z;
}

}  // namespace tetralight::test
