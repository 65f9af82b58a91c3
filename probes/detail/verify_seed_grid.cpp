// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/verify_seed_grid.h>

#include <cmath>
#include <map>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {
namespace {

/// What is wrong with a header; empty if nothing is.
std::string header_problem(const SeedGridHeader& header) {
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(header.min[axis]) || !std::isfinite(header.scale[axis]) ||
            header.scale[axis] < 0.0f) {
            return "has a box that is not finite";
        }
        if (header.size[axis] == 0 || header.size[axis] > kSeedGridLongestSide) {
            return str_cat("has ", header.size[axis], " voxels along an axis");
        }
    }
    return header.reserved == 0 ? std::string() : "has a reserved word that is not zero";
}

/// The grids follow each other without gaps, in any order in which a grid stands behind the voxel
/// that names it.
class Check {
  public:
    explicit Check(const ProbeVolumeView& volume)
        : words_(volume.seed_grid), cell_count_(volume.cells.size()) {}

    Status run() {
        size_t place = 0;
        while (place < words_.size()) {
            const auto named = levels_.extract(place);
            if (!named) return error(place, "no voxel names it");
            if (auto status = check_grid(place, named.mapped()); !status) return status;
        }
        if (levels_.empty()) return Ok{};
        return section_error("seed_grid", str_cat("there is no grid at ", levels_.begin()->first));
    }

  private:
    [[nodiscard]] static Error error(size_t place, const std::string& what) {
        return section_error("seed_grid", str_cat("the grid at ", place, ": ", what));
    }

    /// Moves `place` behind the grid.
    Status check_grid(size_t& place, int level) {
        if (words_.size() - place < kSeedGridHeaderWords) return error(place, "is cut off");
        const SeedGridHeader header = seed_grid_header(words_, place);
        if (auto problem = header_problem(header); !problem.empty()) return error(place, problem);
        const uint64_t count = seed_voxel_count(header);
        const uint64_t room = words_.size() - place - kSeedGridHeaderWords;
        if (count > room) return error(place, str_cat("has ", count, " voxels, room for ", room));
        const size_t first = place + kSeedGridHeaderWords;
        const size_t end = first + static_cast<size_t>(count);
        for (size_t word = first; word < end; ++word) {
            if (auto status = check_word(word, level); !status) return status;
        }
        place = end;
        return Ok{};
    }

    Status check_word(size_t place, int level) {
        const uint32_t word = words_[place];
        if ((word & kFinerGrid) == 0) {
            if (word < cell_count_) return Ok{};
            return element_error("seed_grid", place, "is out of range");
        }
        const size_t finer = word & ~kFinerGrid;
        if (finer <= place || level == kSeedGridLevels) {
            return element_error("seed_grid", place, "names a grid out of place");
        }
        const auto named = levels_.emplace(finer, level + 1).first;
        if (named->second == level + 1) return Ok{};
        return element_error("seed_grid", place, "names a grid of another level");
    }

    std::span<const uint32_t> words_;
    size_t cell_count_;
    /// Grids that voxels name and that are not checked yet: the level by place.
    std::map<size_t, int> levels_{{0, 1}};
};

}  // namespace

Status check_seed_grid(const ProbeVolumeView& volume) {
    return volume.seed_grid.empty() ? Status(Ok{}) : Check(volume).run();
}

}  // namespace tetralight::detail
