// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/probes/detail/cell_weights.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// One step of a walk. Where rounding could change the answer, the next more precise code decides:
// single precision, double, and `Walk`.

namespace tetralight::detail {

/// Factors of the cube of the largest coordinate of a corner, relative to the query.
template <class Real>
struct VolumeLimits;

template <>
struct VolumeLimits<float> {
    /// More than the rounding error of a signed volume: 46 · 2^-24 by the usual forward analysis.
    static constexpr float kRounding = 3e-6f;
    /// A query is inside if no volume is smaller. Beside a face double decides, which is exact
    /// enough for cells that are a needle wide.
    static constexpr float kInside = kRounding;
    /// The same of the sum of four.
    static constexpr float kSumRounding = 1.2e-5f;
    /// Weights in a tetrahedron with a smaller volume may be wrong by more than 2e-6.
    static constexpr float kThin = 0.2f;
    /// Cubes below this have volumes that underflow.
    static constexpr float kLeastCube = 1e-25f;
};

template <>
struct VolumeLimits<double> {
    static constexpr double kRounding = 2e-15;
    static constexpr double kInside = 0.0;
    static constexpr double kSumRounding = 2e-15;
    static constexpr double kThin = 1e-9;
    static constexpr double kLeastCube = 0.0;
};

/// A weight in a hull cell between 0 and minus this is rounding.
inline constexpr double kHullRounding = 1e-12;

/// Tests of a query before its walk continues in the general code.
inline constexpr uint32_t kPassLimit = 512;

enum class Verdict : uint8_t {
    Inside,
    Outside,   ///< the walk continues in `next`
    Doubtful,  ///< more precise code decides
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

/// A walk that leaves a cell by a face. Doubtful if there is no cell behind it.
[[nodiscard]] inline CellTest leave_cell(const ProbeVolumeView& volume, uint32_t cell,
                                         size_t face) noexcept {
    const uint32_t next = volume.cells[cell].neighbors[face];
    return {next < volume.cells.size() ? Verdict::Outside : Verdict::Doubtful, next, {}};
}

/// What follows from the signed volumes of a tetrahedron.
template <class Real>
[[nodiscard]] CellTest judge_volumes(const ProbeVolumeView& volume, uint32_t cell,
                                     const glm::vec<4, Real>& w, Real farthest) noexcept {
    using Limits = VolumeLimits<Real>;
    const Real sum = (w[0] + w[2]) + (w[1] + w[3]);
    const Real smallest = std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
    const Real cube = farthest * farthest * farthest;
    if (!(cube > Limits::kLeastCube)) return {};
    if (sum > Limits::kThin * cube && smallest >= Limits::kInside * cube) {
        const auto positive = [](Real weight) { return weight > Real(0) ? weight : Real(0); };
        const glm::vec<4, Real> kept(positive(w[0]), positive(w[1]), positive(w[2]),
                                     positive(w[3]));
        const Real unit = Real(1) / ((kept[0] + kept[2]) + (kept[1] + kept[3]));
        return {Verdict::Inside, kNoIndex, {cell, 0.0f, glm::vec4(kept * unit)}};
    }
    if (!(sum > Limits::kSumRounding * cube && smallest < -(Limits::kRounding * cube))) return {};
    const size_t face = w[0] == smallest ? 0 : w[1] == smallest ? 1 : w[2] == smallest ? 2 : 3;
    return leave_cell(volume, cell, face);
}

/// Precondition: `cell` is a tetrahedron of a volume that has them.
template <class Real>
[[nodiscard]] CellTest test_tetrahedron(const ProbeVolumeView& volume, uint32_t cell,
                                        const glm::vec<3, Real>& local) noexcept {
    std::array<glm::vec<3, Real>, 4> corners;
    Real farthest = 0;
    for (size_t i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[cell].vertices[i];
        if (probe >= volume.positions.size()) return {};
        corners[i] = glm::vec<3, Real>(volume.positions[probe]) - local;
        for (int axis = 0; axis < 3; ++axis) {
            farthest = std::max(farthest, std::abs(corners[i][axis]));
        }
    }
    return judge_volumes(volume, cell, signed_volumes(corners), farthest);
}

}  // namespace tetralight::detail
