// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/probes/detail/walk.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// One step of a walk. Where rounding could change the answer, `Walk` decides.

namespace tetralight::detail {

/// Times the cube of the largest coordinate of a corner: more than the rounding error of the signed
/// volumes.
inline constexpr double kVolumeRounding = 2e-15;

/// Times the same cube: weights in a tetrahedron with a smaller volume may be wrong by more than
/// 2e-6.
inline constexpr double kThinVolume = 1e-9;

/// A weight in a hull cell between 0 and minus this is rounding.
inline constexpr double kHullRounding = 1e-12;

/// Tests of a query before its walk goes on in double.
inline constexpr uint32_t kPassLimit = 512;

enum class Verdict : uint8_t {
    Inside,
    Outside,   ///< the walk goes on to `next`
    Doubtful,  ///< `Walk` goes on from here
};

struct CellTest {
    Verdict verdict = Verdict::Doubtful;
    uint32_t next = kNoIndex;
    CellLocation location;
};

/// True if the passes support the volume: it has tetrahedra.
[[nodiscard]] inline bool has_tetrahedra(const ProbeVolumeView& volume) noexcept {
    return volume.info.dimension == Dimension::Space && volume.info.inner_cell_count > 0 &&
           volume.info.inner_cell_count <= volume.cells.size() && volume.positions.size() >= 4;
}

/// Precondition: `cell` is a tetrahedron of a volume that has them.
[[nodiscard]] inline CellTest test_tetrahedron(const ProbeVolumeView& volume, uint32_t cell,
                                               const glm::dvec3& local) noexcept {
    const Cell& tetrahedron = volume.cells[cell];
    std::array<glm::dvec3, 4> corners;
    double farthest = 0.0;
    for (size_t i = 0; i < 4; ++i) {
        const uint32_t probe = tetrahedron.vertices[i];
        if (probe >= volume.positions.size()) return {};
        corners[i] = glm::dvec3(volume.positions[probe]) - local;
        for (int axis = 0; axis < 3; ++axis) {
            farthest = std::max(farthest, std::abs(corners[i][axis]));
        }
    }
    const CellWeights volumes{signed_volumes(corners)};
    const auto& w = volumes.weights;
    const double sum = volumes.sum();
    const double smallest = std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
    const double cube = farthest * farthest * farthest;
    const double rounding = kVolumeRounding * cube;
    CellTest test;
    if (sum > kThinVolume * cube && smallest >= 0.0) {
        test.verdict = Verdict::Inside;
        const auto positive = [](double weight) { return weight > 0.0 ? weight : 0.0; };
        const CellWeights kept{{positive(w[0]), positive(w[1]), positive(w[2]), positive(w[3])}};
        test.location = {cell, 0.0f, glm::vec4(kept.weights * (1.0 / kept.sum()))};
    } else if (sum > rounding && smallest < -rounding) {
        const size_t face = w[0] == smallest ? 0 : w[1] == smallest ? 1 : w[2] == smallest ? 2 : 3;
        test.next = tetrahedron.neighbors[face];
        if (test.next < volume.cells.size()) test.verdict = Verdict::Outside;
    }
    return test;
}

}  // namespace tetralight::detail
