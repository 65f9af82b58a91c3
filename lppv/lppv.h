// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_grid.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {

/// Which bands of the light vary from point to point of a grid.
enum class LppvQuality : uint8_t {
    Low,     ///< L0 and L1; there is no L2
    Normal,  ///< L0 and L1; L2 is the same for the whole object, the mean over its grid
    Full,    ///< all nine coefficients
};

/// A light probe proxy volume: the light around one object as a grid.
struct Lppv {
    LppvGrid grid;
    LppvQuality quality = LppvQuality::Full;
    /// One a grid point, x fastest, then y. Band 2 is 0 in `Low`, the same everywhere in `Normal`.
    std::vector<IrradianceSh> irradiance;
    /// Four channels, 1 = lit. Empty: (1, 1, 1, 1).
    std::vector<glm::vec4> occlusion;
    /// Of each grid point, as it was handed in. Empty: 1.
    std::vector<float> validity;
    /// Invalid points that took the light of the nearest valid one.
    uint64_t replaced_count = 0;

    bool operator==(const Lppv&) const = default;
};

/// How a grid is filled.
struct LppvFill {
    LppvQuality quality = LppvQuality::Full;
    /// One a grid point: 1 = free, 0 = inside geometry. Empty: all are free.
    std::span<const float> validity = {};
    /// Points below this take the light of the nearest point that is not. When all are below it,
    /// all keep their own.
    float min_validity = 0.5f;
    OutsideHull outside = {};
};

namespace detail {

/// Some rows of a grid, side by side.
struct LppvBeam {
    glm::uvec3 low{0};
    glm::uvec3 size{0};

    [[nodiscard]] size_t point_count() const noexcept { return size_t{size.x} * size.y * size.z; }
};

/// The parallel part of `fill_lppv`: task i fills some beams of kBeamSide² rows.
struct LppvFillTasks {
    static constexpr uint32_t kBeamSide = 8;

    const ProbeVolumeView& volume;
    const LppvFill& fill;
    Lppv& lppv;
    size_t beams_y = 1;
    size_t beam_count = 1;
    size_t beams_per_task = 1;

    LppvFillTasks(const ProbeVolumeView& from, const LppvFill& how, Lppv& to);

    [[nodiscard]] size_t count() const noexcept;
    void run(size_t task) const;
    void write_beam(const LppvBeam& beam, std::span<const CellLocation> locations) const;
};

[[nodiscard]] Status check_fill(const LppvGrid& grid, const LppvFill& fill);
/// What needs the whole grid: light of invalid points, the constant band 2.
void finish_lppv(const LppvFill& fill, Lppv& lppv);

}  // namespace detail

/// Fills `lppv.grid` with a volume's light on the caller's threads (`interpolate` says what
/// `parallel_for` is), in the memory that `lppv` has where that is enough. The same bytes for any
/// number of threads. Cost: one query a grid point. Error: `validity` is not as long as the grid
/// has points; nothing is changed.
template <class ParallelFor>
[[nodiscard]] Status fill_lppv(const ProbeVolumeView& volume, const LppvFill& fill, Lppv& lppv,
                               ParallelFor&& parallel_for) {
    if (auto status = detail::check_fill(lppv.grid, fill); !status) return status;
    const detail::LppvFillTasks tasks(volume, fill, lppv);
    parallel_for(tasks.count(), [&tasks](size_t task) { tasks.run(task); });
    detail::finish_lppv(fill, lppv);
    return Ok{};
}

/// The same on this thread.
[[nodiscard]] Status fill_lppv(const ProbeVolumeView& volume, const LppvFill& fill, Lppv& lppv);

/// A new one, filled. Errors as `fill_lppv`.
template <class ParallelFor>
[[nodiscard]] Result<Lppv> make_lppv(const ProbeVolumeView& volume, const LppvGrid& grid,
                                     const LppvFill& fill, ParallelFor&& parallel_for) {
    Lppv lppv;
    lppv.grid = grid;
    auto status = fill_lppv(volume, fill, lppv, parallel_for);
    if (!status) return status.error();
    return lppv;
}

[[nodiscard]] Result<Lppv> make_lppv(const ProbeVolumeView& volume, const LppvGrid& grid,
                                     const LppvFill& fill);

/// The light at a world position: trilinear between grid points, and that of the outermost ones
/// outside of them. The twin of runtime/shaders/lppv.glsl. Thread-safe.
[[nodiscard]] InterpolatedProbe sample_lppv(const Lppv& lppv, glm::vec3 position) noexcept;

}  // namespace tetralight
