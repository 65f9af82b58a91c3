// SPDX-License-Identifier: Apache-2.0
#include "lppv/lppv.h"

#include <algorithm>

#include "base/text.h"
#include "lppv/detail/grid_positions.h"
#include "lppv/detail/mean_band_2.h"
#include "lppv/detail/nearest_valid.h"

namespace tetralight {
namespace {

using detail::kFirstOfBand2;

void replace_invalid(const LppvFill& fill, Lppv& lppv) {
    const std::vector<uint32_t> nearest = detail::nearest_valid(
        lppv.grid.resolution, lppv.grid.spacing(), fill.validity, fill.min_validity);
    for (size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i] == i || nearest[i] == kNoIndex) continue;
        lppv.irradiance[i] = lppv.irradiance[nearest[i]];
        if (!lppv.occlusion.empty()) lppv.occlusion[i] = lppv.occlusion[nearest[i]];
        ++lppv.replaced_count;
    }
}

void make_band_2_constant(std::vector<IrradianceSh>& irradiance) {
    const IrradianceSh mean = detail::mean_band_2(irradiance);
    for (IrradianceSh& sh : irradiance) {
        for (int i = kFirstOfBand2; i < kShCoefficientCount; ++i) {
            sh.coefficients[i] = mean.coefficients[i];
        }
    }
}

/// The two grid points beside a coordinate, and the share of the second.
struct Pair {
    uint32_t low = 0;
    uint32_t high = 0;
    float share = 0.0f;
};

Pair pair_at(double coordinate, uint32_t count) {
    const auto low = std::min(static_cast<uint32_t>(coordinate), count - 1);
    return {low, std::min(low + 1, count - 1), static_cast<float>(coordinate - low)};
}

}  // namespace

namespace detail {

LppvFillTasks::LppvFillTasks(const ProbeVolumeView& from, const LppvFill& how, Lppv& to)
    : volume(from), fill(how), lppv(to) {
    const size_t points = lppv.grid.point_count();
    lppv.irradiance.resize(points);
    if (!volume.occlusion.empty()) lppv.occlusion.resize(points);
    lppv.validity.assign(fill.validity.begin(), fill.validity.end());
    rows_per_task = std::max<size_t>(1, kBatchTaskSize / lppv.grid.resolution.x);
}

size_t LppvFillTasks::count() const noexcept {
    const size_t rows = size_t{lppv.grid.resolution.y} * lppv.grid.resolution.z;
    return (rows + rows_per_task - 1) / rows_per_task;
}

/// One batch along the rows: a walk begins in the cell where that of the point before it ended, and
/// at the start of a row, when that is far away, at a seed.
void LppvFillTasks::run(size_t task) const {
    const size_t width = lppv.grid.resolution.x;
    const size_t begin = task * rows_per_task * width;
    const size_t size = std::min(rows_per_task * width, lppv.irradiance.size() - begin);
    std::vector<glm::vec3> positions(size);
    grid_positions(lppv.grid, begin, positions);

    InterpolationBatch batch;
    batch.positions = positions;
    const std::span answers = std::span(lppv.irradiance).subspan(begin, size);
    batch.irradiance = answers;
    if (!lppv.occlusion.empty()) {
        batch.occlusion = std::span(lppv.occlusion).subspan(begin, size);
    }
    batch.outside = fill.outside;
    const auto report = interpolate(volume, batch);
    TETRALIGHT_ASSERT(report, "the spans of a task are as long as its positions");
    if (fill.quality != LppvQuality::Low) return;
    for (IrradianceSh& sh : answers) {
        std::fill(sh.coefficients.begin() + kFirstOfBand2, sh.coefficients.end(), glm::vec3(0.0f));
    }
}

Status check_fill(const LppvGrid& grid, const LppvFill& fill) {
    if (fill.validity.empty() || fill.validity.size() == grid.point_count()) return Ok{};
    return Error{text("validity has ", fill.validity.size(), " values, but the grid has ",
                      grid.point_count(), " points")};
}

void finish_lppv(const LppvFill& fill, Lppv& lppv) {
    if (!fill.validity.empty()) replace_invalid(fill, lppv);
    if (fill.quality == LppvQuality::Normal) make_band_2_constant(lppv.irradiance);
}

}  // namespace detail

Result<Lppv> make_lppv(const ProbeVolumeView& volume, const LppvGrid& grid, const LppvFill& fill) {
    return make_lppv(volume, grid, fill, [](size_t count, auto&& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    });
}

InterpolatedProbe sample_lppv(const Lppv& lppv, glm::vec3 position) noexcept {
    const glm::dvec3 at = lppv.grid.point_coordinates(glm::dvec3(position));
    const glm::uvec3& size = lppv.grid.resolution;
    const Pair x = pair_at(at.x, size.x), y = pair_at(at.y, size.y), z = pair_at(at.z, size.z);
    InterpolatedProbe sum{{}, glm::vec4(lppv.occlusion.empty() ? 1.0f : 0.0f)};
    for (int corner = 0; corner < 8; ++corner) {
        const bool is_x = (corner & 1) != 0, is_y = (corner & 2) != 0, is_z = (corner & 4) != 0;
        const float weight = (is_x ? x.share : 1.0f - x.share) * (is_y ? y.share : 1.0f - y.share) *
                             (is_z ? z.share : 1.0f - z.share);
        if (weight == 0.0f) continue;
        const size_t i = lppv.grid.point_index(
            {is_x ? x.high : x.low, is_y ? y.high : y.low, is_z ? z.high : z.low});
        sum.irradiance += lppv.irradiance[i] * weight;
        if (!lppv.occlusion.empty()) sum.occlusion += lppv.occlusion[i] * weight;
    }
    return sum;
}

}  // namespace tetralight
