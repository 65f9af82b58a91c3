// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/seed_voxels.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

namespace tetralight::detail {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The voxels of a grid whose words are in memory.
size_t voxel_count(const SeedGridHeader& grid) {
    return static_cast<size_t>(seed_voxel_count(grid));
}

/// Copies words and the finer grids that they name.
class WordCopier {
  public:
    WordCopier(const ProbeVolumeView& volume, std::span<const uint32_t> cell_places)
        : words_(volume.seed_grid), cell_places_(cell_places) {}

    std::vector<uint32_t> run(const SeedGridHeader& header, std::span<const uint32_t> voxels) {
        const size_t end = kSeedGridHeaderWords + voxel_count(header);
        next_place_ = end;
        add_header(header);
        for (const uint32_t voxel : voxels) add_word(words_[kSeedGridHeaderWords + voxel]);
        copied_.resize(end, 0);
        for (size_t grid = 0; grid < grids_.size(); ++grid) {
            const size_t from = grids_[grid];
            const SeedGridHeader finer = seed_grid_header(words_, from);
            add_header(finer);
            const size_t count = voxel_count(finer);
            const size_t first = from + static_cast<size_t>(kSeedGridHeaderWords);
            for (size_t i = 0; i < count; ++i) add_word(words_[first + i]);
        }
        return std::move(copied_);
    }

  private:
    void add_header(const SeedGridHeader& header) {
        const size_t place = copied_.size();
        copied_.resize(place + kSeedGridHeaderWords);
        std::memcpy(copied_.data() + place, &header, sizeof header);
    }

    void add_word(uint32_t word) {
        if ((word & kFinerGrid) != 0) {
            copied_.push_back(kFinerGrid | place_of(word & ~kFinerGrid));
        } else {
            const uint32_t cell = cell_places_[word];
            copied_.push_back(cell != kNoIndex ? cell : 0);
        }
    }

    /// Finer grids follow in the order in which words name them first.
    uint32_t place_of(size_t grid) {
        const auto [entry, is_new] = places_.emplace(grid, static_cast<uint32_t>(next_place_));
        if (is_new) {
            grids_.push_back(grid);
            next_place_ += static_cast<size_t>(kSeedGridHeaderWords) +
                           voxel_count(seed_grid_header(words_, grid));
        }
        return entry->second;
    }

    std::span<const uint32_t> words_;
    std::span<const uint32_t> cell_places_;
    std::vector<uint32_t> copied_;
    std::vector<size_t> grids_;
    std::map<size_t, uint32_t> places_;
    size_t next_place_ = 0;
};

}  // namespace

/// Metres by which a position may be beside the voxel that rounding puts it in.
double SeedVoxels::rounding(const SeedGridHeader& grid, size_t axis) const noexcept {
    const double voxels = 1e-3 + static_cast<double>(grid.size[axis]) * 0x1p-21;
    return voxels / static_cast<double>(grid.scale[axis]) +
           2e-7 * static_cast<double>(volume_.info.extent);
}

VoxelRange SeedVoxels::range(const SeedGridHeader& grid,
                             const Box<glm::dvec3>& box) const noexcept {
    VoxelRange range;
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<int>(axis);
        range.counts[axis] = 1;
        if (!(grid.scale[axis] > 0.0f) || grid.size[axis] < 2) continue;
        const auto scale = static_cast<double>(grid.scale[axis]);
        const double margin = 2.0 * rounding(grid, axis);
        const auto last = static_cast<double>(grid.size[axis] - 1);
        const auto voxel = [&](double coordinate) {
            const double along = (coordinate - static_cast<double>(grid.min[axis])) * scale;
            return static_cast<uint32_t>(std::clamp(std::floor(along), 0.0, last));
        };
        range.first[axis] = voxel(box.min[a] - margin);
        range.counts[axis] = voxel(box.max[a] + margin) - range.first[axis] + 1;
    }
    return range;
}

Box<glm::dvec3> SeedVoxels::region(const SeedGridHeader& grid,
                                   const std::array<uint32_t, 3>& voxel) const noexcept {
    Box<glm::dvec3> box{glm::dvec3(-kUnbounded), glm::dvec3(kUnbounded)};
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<int>(axis);
        if (!(grid.scale[axis] > 0.0f)) continue;
        const auto scale = static_cast<double>(grid.scale[axis]);
        const double begin = static_cast<double>(grid.min[axis]) + voxel[axis] / scale;
        if (voxel[axis] > 0) box.min[a] = begin - rounding(grid, axis);
        if (voxel[axis] + 1 < grid.size[axis]) {
            box.max[a] = begin + 1.0 / scale + rounding(grid, axis);
        }
    }
    return box;
}

std::vector<uint32_t> cut_seed_grid(const ProbeVolumeView& volume, const SeedGridHeader& header,
                                    std::span<const uint32_t> voxels,
                                    std::span<const uint32_t> cell_places) {
    return WordCopier(volume, cell_places).run(header, voxels);
}

}  // namespace tetralight::detail
