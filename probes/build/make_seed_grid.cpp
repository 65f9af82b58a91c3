// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_seed_grid.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

#include <tetralight/base/box.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight {
namespace {

constexpr double kVoxelsPerProbe = 6.0;

/// A voxel with more probes has a finer grid.
constexpr uint32_t kMostProbes = 8;

/// If a larger share of the probes is in such voxels, most voxels are empty: fewer will do.
constexpr double kUnevenShare = 0.25;

constexpr double kVoxelsPerProbeIfUneven = 1.0;

/// Voxels of equal sides, about so many, in a box and in a layer around it: walks of positions
/// outside the hull begin in that layer, at a hull cell.
SeedGridHeader make_header(const Box<glm::dvec3>& box, double voxel_count) {
    const glm::dvec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    const auto sides = [&](double along) {
        return glm::max(glm::floor(size * (along / longest)), glm::dvec3(1.0));
    };
    const auto with_layer = [&](double inner, double length) {
        return length > 0.0 ? inner + 2.0 : 1.0;
    };
    SeedGridHeader header;
    header.min = {static_cast<float>(box.min.x), static_cast<float>(box.min.y),
                  static_cast<float>(box.min.z)};
    if (!(longest > 0.0) || !std::isfinite(longest)) return header;
    double coarsest = 1.0;
    double finest = kSeedGridLongestSide - 2;
    for (int i = 0; i < 48; ++i) {  // bisection of the voxels along the longest side
        const double middle = 0.5 * (coarsest + finest);
        const glm::dvec3 inner = sides(middle);
        const double count =
            with_layer(inner.x, size.x) * with_layer(inner.y, size.y) * with_layer(inner.z, size.z);
        (count > voxel_count ? finest : coarsest) = middle;
    }
    const glm::dvec3 inner = sides(coarsest);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        const auto scale = static_cast<float>(inner[axis] / size[axis]);
        if (!(size[axis] > 0.0) || !std::isfinite(scale)) continue;
        header.size[a] = static_cast<uint32_t>(inner[axis]) + 2;
        header.scale[a] = scale;
        header.min[a] = static_cast<float>(box.min[axis] - 1.0 / static_cast<double>(scale));
    }
    return header;
}

/// The word of a voxel that has no cell yet.
constexpr uint32_t kNoCell = kFinerGrid - 1;

uint64_t voxel_count(const SeedGridHeader& header) {
    return uint64_t{header.size[0]} * header.size[1] * header.size[2];
}

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
    struct Voxel {
        uint64_t word = 0;
        glm::vec3 center{0.0f};  ///< world
    };

    /// Probes sorted by their voxel, and where those of each voxel begin.
    struct Sorted {
        std::vector<uint32_t> probes;
        std::vector<uint32_t> begins;

        [[nodiscard]] std::span<const uint32_t> in(size_t voxel) const {
            return std::span(probes).subspan(begins[voxel], begins[voxel + 1] - begins[voxel]);
        }
    };

    /// Counting sort.
    [[nodiscard]] Sorted sort(std::span<const uint32_t> probes,
                              const SeedGridHeader& header) const {
        const auto voxel_of = [&](uint32_t probe) {
            return seed_word(header, 0, volume_.positions[probe]) - kSeedGridHeaderWords;
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
    uint64_t add_grid(std::span<const uint32_t> probes, int level) {
        auto box = Box<glm::dvec3>::empty();
        for (const uint32_t probe : probes) {
            box = union_of(box, glm::dvec3(volume_.positions[probe]));
        }
        const auto count = static_cast<double>(probes.size());
        SeedGridHeader header = make_header(box, kVoxelsPerProbe * count);
        Sorted sorted = sort(probes, header);
        if (level < kSeedGridLevels && is_uneven(sorted)) {
            header = make_header(box, kVoxelsPerProbeIfUneven * count);
            sorted = sort(probes, header);
        }
        const uint64_t place = words_.size();
        grids_.push_back(place);
        words_.resize(place + kSeedGridHeaderWords + voxel_count(header), kNoCell);
        std::memcpy(words_.data() + place, &header, sizeof header);
        for (size_t voxel = 0; voxel < voxel_count(header); ++voxel) {
            add_voxel(header, place, voxel, sorted.in(voxel), level);
        }
        return place;
    }

    void add_voxel(const SeedGridHeader& header, uint64_t place, size_t voxel,
                   std::span<const uint32_t> probes, int level) {
        const uint64_t word = place + kSeedGridHeaderWords + voxel;
        const bool is_split = level < kSeedGridLevels && probes.size() > kMostProbes &&
                              voxel_count(header) > 1 && words_.size() < kFinerGrid;
        if (is_split) {
            const uint64_t finer = add_grid(probes, level + 1);
            words_[word] = kFinerGrid | static_cast<uint32_t>(finer);
            return;
        }
        const std::array<size_t, 3> at{voxel % header.size[0],
                                       voxel / header.size[0] % header.size[1],
                                       voxel / header.size[0] / header.size[1]};
        glm::dvec3 center(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            center[axis] = header.min[a];
            if (header.scale[a] > 0.0f) {
                center[axis] += (static_cast<double>(at[a]) + 0.5) / header.scale[a];
            }
        }
        voxels_.push_back({word, glm::vec3(center + volume_.info.world_origin)});
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
        const uint64_t word = find_seed_word(words_, local);
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
        for (const uint64_t place : grids_) fill_gaps(place);
    }

    void fill_gaps(uint64_t place) {
        const SeedGridHeader header = seed_grid_header(words_, place);
        const std::span voxels =
            std::span(words_).subspan(place + kSeedGridHeaderWords, voxel_count(header));
        const std::array<uint64_t, 3> strides{1, header.size[0],
                                              uint64_t{header.size[0]} * header.size[1]};
        std::vector<uint64_t> filled;
        for (uint64_t i = 0; i < voxels.size(); ++i) {
            if (voxels[i] < kNoCell) filled.push_back(i);
        }
        for (size_t next = 0; next < filled.size(); ++next) {
            const uint64_t from = filled[next];
            for (size_t axis = 0; axis < 3; ++axis) {
                const uint64_t along = from / strides[axis] % header.size[axis];
                const auto fill = [&](uint64_t to) {
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

    void locate_centers() {
        ProbeVolumeView view = volume_;
        const std::vector<uint32_t> words = words_;
        view.seed_grid = words;
        constexpr size_t kPart = 4096;
        std::vector<glm::vec3> centers;
        std::vector<uint32_t> cells(kPart);
        for (size_t begin = 0; begin < voxels_.size(); begin += kPart) {
            const auto part =
                std::span(voxels_).subspan(begin, std::min(kPart, voxels_.size() - begin));
            centers.clear();
            for (const Voxel& voxel : part) centers.push_back(voxel.center);
            find_near_cells(view, centers, cells);
            for (size_t i = 0; i < part.size(); ++i) {
                if (cells[i] < kNoCell) words_[part[i].word] = cells[i];
            }
        }
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
            const uint64_t word = find_seed_word(words_, sum / 3.0f);
            if (word < words_.size() && cell < kNoCell) words_[word] = cell;
        }
    }

    const ProbeVolumeView& volume_;
    std::vector<uint32_t> words_;
    std::vector<uint64_t> grids_;  ///< places
    std::vector<Voxel> voxels_;
};

}  // namespace

std::vector<uint32_t> make_seed_grid(const ProbeVolumeView& volume) {
    if (volume.positions.empty() || volume.cells.empty()) return {};
    return Maker(volume).make();
}

}  // namespace tetralight
