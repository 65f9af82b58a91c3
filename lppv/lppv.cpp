// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv.h>

#include <algorithm>
#include <glm/common.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/lppv/detail/apply_receiver.h>
#include <tetralight/lppv/detail/grid_positions.h>
#include <tetralight/lppv/detail/mean_band_2.h>
#include <tetralight/lppv/detail/nearest_valid.h>
#include <tetralight/lppv/detail/serpentine.h>

namespace tetralight {
namespace {

using detail::kFirstOfBand2;

constexpr auto kThisThread = [](size_t count, auto&& task) {
    for (size_t i = 0; i < count; ++i) task(i);
};

void light_invalid_points(const LppvFill& fill, Lppv& lppv) {
    const std::vector<uint32_t> nearest = detail::nearest_valid(
        lppv.grid.resolution, lppv.grid.spacing(), fill.validity, fill.min_validity);
    lppv.replaced_count +=
        detail::replace_invalid(nearest, std::span(lppv.irradiance), lppv.occlusion);
}

void make_band_2_constant(std::vector<IrradianceSh>& irradiance) {
    const IrradianceSh mean = detail::mean_band_2(irradiance);
    for (IrradianceSh& sh : irradiance) {
        for (int i = kFirstOfBand2; i < kShCoefficientCount; ++i) {
            sh.coefficients[i] = mean.coefficients[i];
        }
    }
}

/// Beams in rows, back and forth, so that consecutive beams are adjacent.
detail::LppvBeam beam_of(const LppvGrid& grid, size_t index, size_t beams_y) {
    const size_t z = index / beams_y;
    const size_t y = z % 2 == 0 ? index % beams_y : beams_y - 1 - index % beams_y;
    constexpr uint32_t kSide = detail::LppvFillTasks::kBeamSide;
    const glm::uvec3 min(0, y * kSide, z * kSide);
    return {min, glm::min(grid.resolution - min, glm::uvec3(grid.resolution.x, kSide, kSide))};
}

/// The two grid points beside a coordinate, and the weight of the second.
struct Pair {
    uint32_t lower = 0;
    uint32_t upper = 0;
    float fraction = 0.0f;
};

Pair pair_at(double coordinate, uint32_t count) {
    const auto lower = std::min(static_cast<uint32_t>(coordinate), count - 1);
    return {lower, std::min(lower + 1, count - 1), static_cast<float>(coordinate - lower)};
}

}  // namespace

namespace detail {

LppvFillTasks::LppvFillTasks(const ProbeVolumeView& from, const LppvFill& how, Lppv& to)
    : volume(from), fill(how), lppv(to) {
    const glm::uvec3& size = lppv.grid.resolution;
    lppv.quality = fill.quality;
    lppv.irradiance.resize(lppv.grid.point_count());
    lppv.occlusion.resize(volume.occlusion.empty() ? 0 : lppv.grid.point_count());
    if (fill.validity.data() != lppv.validity.data()) {
        lppv.validity.assign(fill.validity.begin(), fill.validity.end());
    }
    lppv.replaced_count = 0;
    const size_t beams_z = (size.z + kBeamSide - 1) / kBeamSide;
    beams_y = (size.y + kBeamSide - 1) / kBeamSide;
    beam_count = beams_y * beams_z;
    // The output of a task stays in the cache of one core while it locates its points.
    constexpr size_t kTaskPoints = 8192;
    const size_t points =
        size_t{size.x} * std::min(size.y, kBeamSide) * std::min(size.z, kBeamSide);
    beams_per_task = std::max<size_t>(1, kTaskPoints / points);
}

size_t LppvFillTasks::count() const noexcept {
    return (beam_count + beams_per_task - 1) / beams_per_task;
}

/// Points are located in an order in which consecutive points are neighbors, so that the walk from
/// cell to cell is short. Light is blended in the order of the grid, so that memory is written in
/// order.
void LppvFillTasks::run(size_t task) const {
    const GridPositions position_of(lppv.grid);
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> places;
    std::vector<LppvBeam> beams;
    Serpentine serpentine;
    const size_t last = std::min((task + 1) * beams_per_task, beam_count);
    for (size_t i = task * beams_per_task; i < last; ++i) {
        const LppvBeam beam = beam_of(lppv.grid, i, beams_y);
        const auto first = static_cast<uint32_t>(positions.size());
        serpentine.walk(beam.size, [&](const glm::uvec3& point) {
            positions.push_back(position_of(beam.min + point));
            places.push_back(first + (point.z * beam.size.y + point.y) * beam.size.x + point.x);
        });
        beams.push_back(beam);
    }
    std::vector<CellLocation> found(positions.size()), locations(positions.size());
    locate(volume, positions, found, fill.outside);
    for (size_t i = 0; i < found.size(); ++i) locations[places[i]] = found[i];
    const Walls walls = apply_receiver(volume, locations, fill.receiver);
    std::span<const CellLocation> remaining = locations;
    for (const LppvBeam& beam : beams) {
        write_beam(beam, remaining.first(beam.point_count()), walls);
        remaining = remaining.subspan(beam.point_count());
    }
}

/// Writes consecutive rows in memory together.
void LppvFillTasks::write_beam(const LppvBeam& beam, std::span<const CellLocation> locations,
                               Walls walls) const {
    const bool is_contiguous = beams_y == 1;
    const size_t count = is_contiguous ? locations.size() : beam.size.x;
    for (size_t i = 0; i < locations.size(); i += count) {
        const size_t row = i / beam.size.x;
        const glm::uvec3 start = beam.min + glm::uvec3(0, row % beam.size.y, row / beam.size.y);
        const size_t at = lppv.grid.point_index(start);
        const std::span irradiance = std::span(lppv.irradiance).subspan(at, count);
        OcclusionOutput occlusion;
        if (!lppv.occlusion.empty()) occlusion = std::span(lppv.occlusion).subspan(at, count);
        const auto status =
            blend(volume, locations.subspan(i, count), irradiance, occlusion, walls);
        TETRALIGHT_ASSERT(status, "the output has one element per location");
        if (fill.quality != LppvQuality::Low) continue;
        for (IrradianceSh& sh : irradiance) {
            std::fill(sh.coefficients.begin() + kFirstOfBand2, sh.coefficients.end(),
                      glm::vec3(0.0f));
        }
    }
}

Status check_fill(const LppvGrid& grid, const LppvFill& fill) {
    if (fill.validity.empty() || fill.validity.size() == grid.point_count()) return Ok{};
    return Error{ErrorCode::InvalidArgument, "validity", str_cat(fill.validity.size()),
                 str_cat("validity has ", fill.validity.size(), " values, but the grid has ",
                         grid.point_count(), " points")};
}

void finish_lppv(const LppvFill& fill, Lppv& lppv) {
    if (!fill.validity.empty()) light_invalid_points(fill, lppv);
    if (fill.quality == LppvQuality::Normal) make_band_2_constant(lppv.irradiance);
}

}  // namespace detail

Status fill_lppv(const ProbeVolumeView& volume, const LppvFill& fill, Lppv& lppv) {
    return fill_lppv(volume, fill, lppv, kThisThread);
}

Result<Lppv> make_lppv(const ProbeVolumeView& volume, const LppvGrid& grid, const LppvFill& fill) {
    return make_lppv(volume, grid, fill, kThisThread);
}

InterpolatedProbe sample_lppv(const Lppv& lppv, glm::vec3 position) noexcept {
    const glm::dvec3 at = lppv.grid.point_coordinates(glm::dvec3(position));
    const glm::uvec3& size = lppv.grid.resolution;
    const Pair x = pair_at(at.x, size.x), y = pair_at(at.y, size.y), z = pair_at(at.z, size.z);
    InterpolatedProbe sum{{}, glm::vec4(lppv.occlusion.empty() ? 1.0f : 0.0f)};
    for (int corner = 0; corner < 8; ++corner) {
        const bool is_x = (corner & 1) != 0, is_y = (corner & 2) != 0, is_z = (corner & 4) != 0;
        const float weight = (is_x ? x.fraction : 1.0f - x.fraction) *
                             (is_y ? y.fraction : 1.0f - y.fraction) *
                             (is_z ? z.fraction : 1.0f - z.fraction);
        if (weight == 0.0f) continue;
        const size_t i = lppv.grid.point_index(
            {is_x ? x.upper : x.lower, is_y ? y.upper : y.lower, is_z ? z.upper : z.lower});
        sum.irradiance += lppv.irradiance[i] * weight;
        if (!lppv.occlusion.empty()) sum.occlusion += lppv.occlusion[i] * weight;
    }
    return sum;
}

}  // namespace tetralight
