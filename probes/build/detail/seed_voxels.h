// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {

/// Voxels of one grid of a seed grid.
struct VoxelRange {
    std::array<uint32_t, 3> first{};
    std::array<uint32_t, 3> counts{};
};

/// The local positions whose walks begin at the words of a seed grid, with what rounding adds.
class SeedVoxels {
  public:
    /// Precondition: the volume has a seed grid, passes `verify`, and outlives this object.
    explicit SeedVoxels(const ProbeVolumeView& volume) : volume_(volume) {}

    /// Those whose positions may be in a local box.
    [[nodiscard]] VoxelRange range(const SeedGridHeader& grid,
                                   const Box<glm::dvec3>& box) const noexcept;

    /// The positions of a voxel: unbounded at the ends of the grid.
    [[nodiscard]] Box<glm::dvec3> region(const SeedGridHeader& grid,
                                         const std::array<uint32_t, 3>& voxel) const noexcept;

    /// Calls visit(cell, region) for each cell in which walks to positions of the box begin that
    /// the grid at `place` names, with the part of the box whose walks begin there.
    template <class Visit>
    void for_each_start(const Box<glm::dvec3>& box, const Visit& visit, size_t place = 0,
                        int level = 1) const {
        const SeedGridHeader grid = seed_grid_header(volume_.seed_grid, place);
        const VoxelRange range = this->range(grid, box);
        const auto& [first, counts] = range;
        std::array<uint32_t, 3> at{};
        for (at[2] = first[2]; at[2] < first[2] + counts[2]; ++at[2]) {
            for (at[1] = first[1]; at[1] < first[1] + counts[1]; ++at[1]) {
                for (at[0] = first[0]; at[0] < first[0] + counts[0]; ++at[0]) {
                    visit_voxel(grid, place, at, box, level, visit);
                }
            }
        }
    }

    /// The same for one voxel of a grid.
    template <class Visit>
    void visit_voxel(const SeedGridHeader& grid, size_t place, const std::array<uint32_t, 3>& at,
                     const Box<glm::dvec3>& box, int level, const Visit& visit) const {
        const Box<glm::dvec3> part = intersection_of(region(grid, at), box);
        if (part.min.x > part.max.x || part.min.y > part.max.y || part.min.z > part.max.z) return;
        const size_t row = size_t{at[2]} * grid.size[1] + at[1];
        const uint32_t word =
            volume_.seed_grid[place + kSeedGridHeaderWords + row * grid.size[0] + at[0]];
        if ((word & kFinerGrid) == 0) {
            visit(word, part);
        } else if (level < kSeedGridLevels) {
            for_each_start(part, visit, word & ~kFinerGrid, level + 1);
        }
    }

  private:
    [[nodiscard]] double rounding(const SeedGridHeader& grid, size_t axis) const noexcept;

    const ProbeVolumeView& volume_;
};

/// The seed grid of a part of a volume. Its outermost grid has `header` and the words of the given
/// voxels of that of the volume, in their order, then zeros; finer grids are copied whole.
/// `cell_places`: as in `cut_cells`; words of other cells become 0.
[[nodiscard]] std::vector<uint32_t> cut_seed_grid(const ProbeVolumeView& volume,
                                                  const SeedGridHeader& header,
                                                  std::span<const uint32_t> voxels,
                                                  std::span<const uint32_t> cell_places);

}  // namespace tetralight::detail
