// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/sampled_grid.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

/// Half the thickness that a box gets along an axis without extent, metres.
constexpr double kHalfThickness = 0.5;

Error invalid(const char* field, std::string message) {
    return {ErrorCode::InvalidArgument, field, "", std::move(message)};
}

/// The box of probes of a plane, a line or a point has no volume.
Box<glm::dvec3> thickened(Box<glm::dvec3> box) {
    for (int axis = 0; axis < 3; ++axis) {
        if (box.max[axis] > box.min[axis]) continue;
        box.min[axis] -= kHalfThickness;
        box.max[axis] += kHalfThickness;
    }
    return box;
}

double mean_spacing(const Box<glm::dvec3>& box, uint32_t probe_count) {
    const glm::dvec3 size = box.size();
    return std::cbrt(size.x * size.y * size.z / std::max(probe_count, 1u));
}

Result<glm::uvec3> chosen_resolution(const ProbeVolumeView& volume, const Box<glm::dvec3>& box,
                                     const ExportSettings& settings) {
    const double spacing = settings.spacing > 0.0 ? settings.spacing
                                                  : mean_spacing(thickened(world_bounds(volume)),
                                                                 volume.probe_count());
    const bool is_given = settings.resolution[0] > 0;
    const char* field = is_given ? "resolution" : "spacing";
    glm::dvec3 cells(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        cells[axis] = is_given ? settings.resolution[static_cast<size_t>(axis)]
                               : std::max(1.0, std::ceil(box.size()[axis] / spacing - 1e-6));
        if (!(cells[axis] >= 1.0 && cells[axis] <= kMostGridCellsOfAxis)) {
            return invalid(field, str_cat("gives ", cells[axis], " cells along ", "xyz"[axis],
                                          "; 1 to ", kMostGridCellsOfAxis, " are possible"));
        }
    }
    const double count = cells.x * cells.y * cells.z;
    if (count > kMostGridCells) {
        return invalid(field,
                       str_cat("gives ", count, " cells; up to ", kMostGridCells, " are possible"));
    }
    return glm::uvec3(cells);
}

}  // namespace

Box<glm::dvec3> world_bounds(const ProbeVolumeView& volume) {
    if (volume.positions.empty()) return {volume.info.world_origin, volume.info.world_origin};
    auto box = Box<glm::dvec3>::empty();
    for (const glm::vec3& position : volume.positions) {
        box = union_of(box, volume.info.world_origin + glm::dvec3(position));
    }
    return box;
}

glm::dvec3 SampledGrid::center(uint32_t x, uint32_t y, uint32_t z) const {
    const glm::dvec3 cell = bounds.size() / glm::dvec3(resolution);
    return bounds.min + (glm::dvec3(x, y, z) + 0.5) * cell;
}

IrradianceSh SampledGrid::sample(const glm::dvec3& position) const {
    glm::uvec3 low(0);
    glm::uvec3 high(0);
    glm::dvec3 share(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double last = resolution[axis] - 1.0;
        const double place =
            (position[axis] - bounds.min[axis]) / bounds.size()[axis] * resolution[axis] - 0.5;
        const double clamped = std::clamp(place, 0.0, last);
        low[axis] = static_cast<uint32_t>(std::min(std::floor(clamped), last));
        high[axis] = std::min(low[axis] + 1, resolution[axis] - 1);
        share[axis] = clamped - low[axis];
    }
    IrradianceSh sum;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        glm::uvec3 cell(0);
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_high = (corner >> axis & 1) != 0;
            weight *= is_high ? share[axis] : 1.0 - share[axis];
            cell[axis] = is_high ? high[axis] : low[axis];
        }
        sum += at(cell.x, cell.y, cell.z) * static_cast<float>(weight);
    }
    return sum;
}

Result<SampledGrid> sample_grid(const ProbeVolumeView& volume, const ExportSettings& settings) {
    SampledGrid grid;
    grid.bounds = settings.bounds ? *settings.bounds : thickened(world_bounds(volume));
    if (!all(lessThan(grid.bounds.min, grid.bounds.max))) {
        return invalid("bounds", "the minimum is not below the maximum along each axis");
    }
    const auto resolution = chosen_resolution(volume, grid.bounds, settings);
    if (!resolution) return resolution.error();
    grid.resolution = *resolution;
    std::vector<glm::vec3> centers;
    centers.reserve(size_t{grid.resolution.x} * grid.resolution.y * grid.resolution.z);
    for (uint32_t z = 0; z < grid.resolution.z; ++z) {
        for (uint32_t y = 0; y < grid.resolution.y; ++y) {
            for (uint32_t x = 0; x < grid.resolution.x; ++x) {
                centers.emplace_back(grid.center(x, y, z));
            }
        }
    }
    grid.light.resize(centers.size());
    const auto report = interpolate(volume, {.positions = centers, .irradiance = grid.light});
    if (!report) return report.error();
    return grid;
}

LightDifference measure_difference(const ProbeVolumeView& volume, const SampledGrid& grid) {
    return measure_difference(volume, random_places(volume, kDifferencePlaces, grid.bounds),
                              [&](const glm::dvec3& position) { return grid.sample(position); });
}

}  // namespace tetralight
