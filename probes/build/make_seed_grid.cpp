// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seed_grid.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

#include <tetralight/base/box.h>
#include <tetralight/probes/build/detail/seed_grid_header.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight {
namespace {

constexpr double kVoxelsPerProbe = 6.0;

/// A voxel with more probes has a finer grid.
constexpr uint32_t kMostProbes = 8;

/// If a larger share of the probes is in such voxels, most voxels are empty: fewer will do.
constexpr double kUnevenShare = 0.25;

constexpr double kVoxelsPerProbeIfUneven = 1.0;

/// The word of a voxel that has no cell yet.
constexpr uint32_t kNoCell = kFinerGrid - 1;

class Maker {
  public:
    explicit Maker(const ProbeVolumeView& volume) : volume_(volume) {}

    std::vector<uint32_t> make() {
        std::vector<uint32_t> probes(volume_.positions.size());
        std::iota(probes.begin(), probes.end(), 0u);
        add_grid(probes, 1);
        enter_cells();
        fill_gaps();
        locate_centers();
        prefer_hull_cells();
        return std::move(words_);
    }

  private:
    /// Probes sorted by their voxel, and where those of each voxel begin.
    struct Sorted {
        std::vector<uint32_t> probes;
        std::vector<uint32_t> begins;

        [[nodiscard]] std::span<const uint32_t> in(size_t voxel) const {
            return std::span(probes).subspan(begins[voxel], begins[voxel + 1] - begins[voxel]);
        }
    };

    /// The voxels of a grid whose words are in memory or will be.
    [[nodiscard]] static size_t voxel_count(const SeedGridHeader& header) {
        return static_cast<size_t>(seed_voxel_count(header));
    }

    /// Counting sort.
    [[nodiscard]] Sorted sort(std::span<const uint32_t> probes,
                              const SeedGridHeader& header) const {
        const auto voxel_of = [&](uint32_t probe) {
            const uint64_t word = seed_word(header, 0, volume_.positions[probe]);
            return static_cast<size_t>(word) - kSeedGridHeaderWords;
        };
        Sorted sorted{std::vector<uint32_t>(probes.size()),
                      std::vector<uint32_t>(voxel_count(header) + 2, 0u)};
        for (const uint32_t probe : probes) ++sorted.begins[voxel_of(probe) + 2];
        std::partial_sum(sorted.begins.begin(), sorted.begins.end(), sorted.begins.begin());
        for (const uint32_t probe : probes) {
            sorted.probes[sorted.begins[voxel_of(probe) + 1]++] = probe;
        }
        return sorted;
    }

    [[nodiscard]] static bool is_uneven(const Sorted& sorted) {
        size_t crowded = 0;
        for (size_t voxel = 0; voxel + 2 < sorted.begins.size(); ++voxel) {
            const size_t count = sorted.in(voxel).size();
            if (count > kMostProbes) crowded += count;
        }
        return static_cast<double>(crowded) >
               kUnevenShare * static_cast<double>(sorted.probes.size());
    }

    /// Adds the grid of some probes and those inside it; returns its place.
    size_t add_grid(std::span<const uint32_t> probes, int level) {
        const Box<glm::dvec3> box = box_of(probes);
        const auto count = static_cast<double>(probes.size());
        SeedGridHeader header = detail::make_seed_grid_header(box, kVoxelsPerProbe * count);
        Sorted sorted = sort(probes, header);
        if (level < kSeedGridLevels && is_uneven(sorted)) {
            header = detail::make_seed_grid_header(box, kVoxelsPerProbeIfUneven * count);
            sorted = sort(probes, header);
        }
        const size_t place = words_.size();
        grids_.push_back(place);
        words_.resize(place + kSeedGridHeaderWords + voxel_count(header), kNoCell);
        std::memcpy(words_.data() + place, &header, sizeof header);
        std::vector<size_t> clusters;
        for (size_t voxel = 0; voxel < voxel_count(header); ++voxel) {
            const auto inside = sorted.in(voxel);
            add_voxel(header, place, voxel, inside, level);
            const bool is_split = (words_[place + kSeedGridHeaderWords + voxel] & kFinerGrid) != 0;
            if (is_split && is_small(inside, header)) clusters.push_back(voxel);
        }
        for (const size_t voxel : clusters) share_grid(header, place, voxel);
        return place;
    }

    /// True if the probes fill a small part of the sides of a voxel.
    [[nodiscard]] bool is_small(std::span<const uint32_t> probes,
                                const SeedGridHeader& header) const {
        constexpr double kSmallShare = 0.125;
        const glm::dvec3 size = box_of(probes).max - box_of(probes).min;
        for (int axis = 0; axis < 3; ++axis) {
            const auto scale = static_cast<double>(header.scale[static_cast<size_t>(axis)]);
            if (size[axis] * scale > kSmallShare) return false;
        }
        return true;
    }

    /// Voxels around one with a finer grid name that grid as well, unless they have their own: a
    /// cluster may be at the border of its voxel, and the voxel beside it would name a cell far
    /// away.
    void share_grid(const SeedGridHeader& header, size_t place, size_t voxel) {
        const auto at = voxel_position(header, voxel);
        const size_t first = place + kSeedGridHeaderWords;
        for (int code = 0; code < 27; ++code) {
            const std::array<int, 3> steps{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
            std::array<size_t, 3> to{};
            bool is_inside = true;
            for (size_t axis = 0; axis < 3; ++axis) {
                to[axis] = at[axis] + static_cast<size_t>(steps[axis]);  // −1 wraps around
                is_inside = is_inside && to[axis] < header.size[axis];
            }
            if (!is_inside) continue;
            const size_t other = (to[2] * header.size[1] + to[1]) * header.size[0] + to[0];
            uint32_t& word = words_[first + other];
            if ((word & kFinerGrid) == 0) word = words_[first + voxel];
        }
    }

    [[nodiscard]] static std::array<size_t, 3> voxel_position(const SeedGridHeader& header,
                                                              size_t voxel) {
        return {voxel % header.size[0], voxel / header.size[0] % header.size[1],
                voxel / header.size[0] / header.size[1]};
    }

    [[nodiscard]] Box<glm::dvec3> box_of(std::span<const uint32_t> probes) const {
        auto box = Box<glm::dvec3>::empty();
        for (const uint32_t probe : probes) {
            box = union_of(box, glm::dvec3(volume_.positions[probe]));
        }
        return box;
    }

    void add_voxel(const SeedGridHeader& header, size_t place, size_t voxel,
                   std::span<const uint32_t> probes, int level) {
        const size_t word = place + kSeedGridHeaderWords + voxel;
        const bool is_split = level < kSeedGridLevels && probes.size() > kMostProbes &&
                              voxel_count(header) > 1 && words_.size() < kFinerGrid;
        if (!is_split) return;
        const size_t finer = add_grid(probes, level + 1);
        words_[word] = kFinerGrid | static_cast<uint32_t>(finer);
    }

    /// Names in each voxel a cell whose middle is in it. Hull cells have theirs above the triangle.
    void enter_cells() {
        const std::vector<float> heights = hull_heights();
        for (uint32_t cell = 0; cell < volume_.cells.size() && cell < kNoCell; ++cell) {
            glm::vec3 sum(0.0f);
            float count = 0.0f;
            for (const uint32_t probe : volume_.cells[cell].vertices) {
                if (probe == kNoIndex) continue;
                sum += volume_.positions[probe];
                count += 1.0f;
            }
            const glm::vec3 middle = sum / count;
            if (cell < volume_.info.inner_cell_count) {
                enter(cell, middle);
                continue;
            }
            const HullCellRays& rays = volume_.hull_rays[cell - volume_.info.inner_cell_count];
            for (const float height : heights) enter(cell, middle + height * rays.rays[0]);
        }
    }

    void enter(uint32_t cell, const glm::vec3& local) {
        const size_t word = find_seed_word(words_, local);
        if (word < words_.size() && words_[word] == kNoCell) words_[word] = cell;
    }

    /// Half a voxel and one and a half of the outermost grid.
    [[nodiscard]] std::vector<float> hull_heights() const {
        const SeedGridHeader header = seed_grid_header(words_, 0);
        const float scale = std::max({header.scale[0], header.scale[1], header.scale[2]});
        return scale > 0.0f ? std::vector{0.5f / scale, 1.5f / scale} : std::vector<float>{};
    }

    /// Voxels without a cell take that of the voxel next to them that has one.
    void fill_gaps() {
        for (const size_t place : grids_) fill_gaps(place);
    }

    void fill_gaps(size_t place) {
        const SeedGridHeader header = seed_grid_header(words_, place);
        const std::span voxels =
            std::span(words_).subspan(place + kSeedGridHeaderWords, voxel_count(header));
        const std::array<size_t, 3> strides{1, header.size[0],
                                            size_t{header.size[0]} * header.size[1]};
        std::vector<size_t> filled;
        for (size_t i = 0; i < voxels.size(); ++i) {
            if (voxels[i] < kNoCell) filled.push_back(i);
        }
        for (size_t next = 0; next < filled.size(); ++next) {
            const size_t from = filled[next];
            for (size_t axis = 0; axis < 3; ++axis) {
                const size_t along = from / strides[axis] % header.size[axis];
                const auto fill = [&](size_t to) {
                    if (voxels[to] != kNoCell) return;
                    voxels[to] = voxels[from];
                    filled.push_back(to);
                };
                if (along > 0) fill(from - strides[axis]);
                if (along + 1 < header.size[axis]) fill(from + strides[axis]);
            }
        }
        std::ranges::replace(voxels, kNoCell, 0u);
    }

    /// Voxels without a finer grid name the cell at their center.
    void locate_centers() {
        const std::vector<uint32_t> words = words_;
        ProbeVolumeView view = volume_;
        view.seed_grid = words;
        for (const size_t place : grids_) locate_centers(view, place);
    }

    void locate_centers(const ProbeVolumeView& view, size_t place) {
        const SeedGridHeader header = seed_grid_header(words_, place);
        const std::span voxels =
            std::span(words_).subspan(place + kSeedGridHeaderWords, voxel_count(header));
        constexpr size_t kPart = 4096;
        std::vector<glm::vec3> centers;
        std::vector<uint32_t> cells(kPart);
        for (size_t begin = 0; begin < voxels.size(); begin += kPart) {
            const auto part = voxels.subspan(begin, std::min(kPart, voxels.size() - begin));
            centers.clear();
            for (size_t i = 0; i < part.size(); ++i) centers.push_back(center(header, begin + i));
            find_near_cells(view, centers, std::span(cells).first(part.size()));
            for (size_t i = 0; i < part.size(); ++i) {
                if (cells[i] < kNoCell && (part[i] & kFinerGrid) == 0) part[i] = cells[i];
            }
        }
    }

    /// In the world.
    [[nodiscard]] glm::vec3 center(const SeedGridHeader& header, size_t voxel) const {
        const std::array<size_t, 3> at = voxel_position(header, voxel);
        glm::dvec3 center(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            center[axis] = header.min[a];
            if (header.scale[a] > 0.0f) {
                center[axis] += (static_cast<double>(at[a]) + 0.5) / header.scale[a];
            }
        }
        return glm::vec3(center + volume_.info.world_origin);
    }

    /// Voxels with the middle of a hull triangle begin at its hull cell. Below smooth layers of
    /// probes the tetrahedra are stacked by the hundred, and no walk from there to the hull is
    /// short.
    void prefer_hull_cells() {
        if (volume_.info.dimension != Dimension::Space) return;
        for (size_t i = 0; i < volume_.hull_rays.size(); ++i) {
            const auto cell = static_cast<uint32_t>(volume_.info.inner_cell_count + i);
            glm::vec3 sum(0.0f);
            for (size_t k = 0; k < 3; ++k) {
                sum += volume_.positions[volume_.cells[cell].vertices[k]];
            }
            const size_t word = find_seed_word(words_, sum / 3.0f);
            if (word < words_.size() && cell < kNoCell) words_[word] = cell;
        }
    }

    const ProbeVolumeView& volume_;
    std::vector<uint32_t> words_;
    std::vector<size_t> grids_;  ///< places
};

}  // namespace

std::vector<uint32_t> make_seed_grid(const ProbeVolumeView& volume) {
    if (volume.positions.empty() || volume.cells.empty()) return {};
    return Maker(volume).make();
}

}  // namespace tetralight
