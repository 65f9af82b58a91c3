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
#include <tetralight/probes/receiver.h>

namespace tetralight {

/// The bands of the light that vary between the points of a grid.
enum class LppvQuality : uint8_t {
    Low,     ///< L0 and L1, without L2
    Normal,  ///< L0 and L1; L2 is the same for the whole object, the mean over its grid
    Full,    ///< all nine coefficients
};

/// A light probe proxy volume: a grid of light around one object.
struct Lppv {
    LppvGrid grid;
    LppvQuality quality = LppvQuality::Full;
    /// One per grid point, x fastest, then y. Band 2 is 0 in `Low` and constant in `Normal`.
    std::vector<IrradianceSh> irradiance;
    /// Four channels per grid point, 1 = lit. Empty: all are (1, 1, 1, 1).
    std::vector<glm::vec4> occlusion;
    /// One per grid point, copied from `LppvFill::validity`. Empty: all are 1.
    std::vector<float> validity;
    /// Number of invalid points that took the light of the nearest valid point.
    uint64_t replaced_count = 0;

    bool operator==(const Lppv&) const = default;
};

/// The settings of `fill_lppv`.
struct LppvFill {
    LppvQuality quality = LppvQuality::Full;
    /// One per grid point: 1 = free, 0 = inside geometry. Empty: all points are free.
    std::span<const float> validity = {};
    /// A point with a lower validity takes the light of the nearest point with at least this one.
    /// If there is no such point, all points keep their light.
    float min_validity = 0.5f;
    OutsideHull outside = {};
    /// The object: which probes light it.
    Receiver receiver = {};
};

namespace detail {

/// Adjacent rows of a grid.
struct LppvBeam {
    glm::uvec3 min{0};
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
    void write_beam(const LppvBeam& beam, std::span<const CellLocation> locations,
                    Walls walls) const;
};

[[nodiscard]] Status check_fill(const LppvGrid& grid, const LppvFill& fill);
/// The steps that need all points: the light of invalid points and the constant band 2.
void finish_lppv(const LppvFill& fill, Lppv& lppv);

}  // namespace detail

/// Fills `lppv.grid` with the light of a probe volume on the caller's threads (`interpolate`
/// describes `parallel_for`). Reuses the memory of `lppv` if it suffices. Gives the same bytes for
/// any number of threads. Cost: one query per grid point. Returns invalid_argument, and changes
/// nothing, if `validity` does not have one value per grid point.
template <class ParallelFor>
[[nodiscard]] Status fill_lppv(const ProbeVolumeView& volume, const LppvFill& fill, Lppv& lppv,
                               ParallelFor&& parallel_for) {
    if (auto status = detail::check_fill(lppv.grid, fill); !status) return status;
    const detail::LppvFillTasks tasks(volume, fill, lppv);
    parallel_for(tasks.count(), [&tasks](size_t task) { tasks.run(task); });
    detail::finish_lppv(fill, lppv);
    return Ok{};
}

/// The same on the calling thread.
[[nodiscard]] Status fill_lppv(const ProbeVolumeView& volume, const LppvFill& fill, Lppv& lppv);

/// Makes and fills a proxy volume. Errors: those of `fill_lppv`.
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

/// The light at a world position: trilinear between grid points; outside the grid, the light at the
/// nearest position in it. The twin of runtime/shaders/lppv.glsl. Thread-safe.
[[nodiscard]] InterpolatedProbe sample_lppv(const Lppv& lppv, glm::vec3 position) noexcept;

}  // namespace tetralight
