// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/base/result.h>
#include <tetralight/engines/export_target.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The light of a volume at the centers of the cells of a world box, as grids of engines hold it.
struct SampledGrid {
    Box<glm::dvec3> bounds;
    glm::uvec3 resolution{1};
    /// x varies fastest, then y, then z.
    std::vector<IrradianceSh> light;

    [[nodiscard]] const IrradianceSh& at(uint32_t x, uint32_t y, uint32_t z) const {
        return light[(size_t{z} * resolution.y + y) * resolution.x + x];
    }

    /// World position of the center of a cell.
    [[nodiscard]] glm::dvec3 center(uint32_t x, uint32_t y, uint32_t z) const;

    /// What a texture with linear filtering shows: between centers interpolated along each axis,
    /// beyond the outermost ones constant.
    [[nodiscard]] IrradianceSh sample(const glm::dvec3& position) const;
};

/// Cells of a grid along an axis, and of all of it.
inline constexpr uint32_t kMostGridCellsOfAxis = 2048, kMostGridCells = 1u << 22;

/// Samples the volume in the box, and with the resolution, that the settings ask for. Returns
/// invalid_argument if the box is not a box, or the grid has more than `kMostGridCellsOfAxis` or
/// `kMostGridCells` cells.
[[nodiscard]] Result<SampledGrid> sample_grid(const ProbeVolumeView& volume,
                                              const ExportSettings& settings);

/// How far the grid is from the volume, at random places in both.
[[nodiscard]] LightDifference measure_difference(const ProbeVolumeView& volume,
                                                 const SampledGrid& grid);

/// The world box of the probes; a point without probes.
[[nodiscard]] Box<glm::dvec3> world_bounds(const ProbeVolumeView& volume);

}  // namespace tetralight
