// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>

#include <tetralight/probes/probe_volume.h>

// The seed grid of a volume: a cell near each position, found by two or three reads. Section
// "seed_grid" is an array of 32-bit words: a grid, then the finer grids inside its voxels.
//
//     0       SeedGridHeader                                  10 words
//     10      one word a voxel, x fastest                     size.x · size.y · size.z words
//
// The word of a voxel is the cell at its center, or kFinerGrid + the place of a finer grid.

namespace tetralight {

/// The first words of a grid.
struct SeedGridHeader {
    std::array<float, 3> min{};    ///< lowest corner, local
    std::array<float, 3> scale{};  ///< voxels a metre; 0 along an axis with one voxel
    std::array<uint32_t, 3> size{1, 1, 1};
    uint32_t reserved = 0;

    bool operator==(const SeedGridHeader&) const = default;
};

static_assert(sizeof(SeedGridHeader) == 40 && std::is_trivially_copyable_v<SeedGridHeader>);

inline constexpr size_t kSeedGridHeaderWords = sizeof(SeedGridHeader) / sizeof(uint32_t);

/// A word of a voxel with this bit names a finer grid.
inline constexpr uint32_t kFinerGrid = 0x80000000u;

/// Grids inside each other, the outermost included.
inline constexpr int kSeedGridLevels = 4;

/// Voxels along one axis.
inline constexpr uint32_t kSeedGridLongestSide = 1u << 20;

/// Precondition: all words of the header are in the section.
[[nodiscard]] inline SeedGridHeader seed_grid_header(std::span<const uint32_t> words,
                                                     size_t place) noexcept {
    SeedGridHeader header;
    std::memcpy(static_cast<void*>(&header), words.data() + place, sizeof header);
    return header;
}

/// Words of voxels.
[[nodiscard]] inline uint64_t seed_voxel_count(const SeedGridHeader& grid) noexcept {
    return uint64_t{grid.size[0]} * grid.size[1] * grid.size[2];
}

/// The voxel along one axis that is nearest to a local coordinate; 0 if that is not a number.
[[nodiscard]] inline uint32_t seed_voxel(float coordinate, float min, float scale,
                                         uint32_t size) noexcept {
    const uint32_t side = size < kSeedGridLongestSide ? size : kSeedGridLongestSide;
    const uint32_t last = side > 0 ? side - 1 : 0;  // 0: a corrupt grid
    const float along = (coordinate - min) * scale;
    const auto limit = static_cast<float>(last);
    return static_cast<uint32_t>(along > 0.0f ? (along < limit ? along : limit) : 0.0f);
}

/// The place of the word for a local position in one grid. Not tested: sizes may be corrupt.
[[nodiscard]] inline uint64_t seed_word(const SeedGridHeader& grid, uint64_t place,
                                        const glm::vec3& local) noexcept {
    const uint64_t x = seed_voxel(local.x, grid.min[0], grid.scale[0], grid.size[0]);
    const uint64_t y = seed_voxel(local.y, grid.min[1], grid.scale[1], grid.size[1]);
    const uint64_t z = seed_voxel(local.z, grid.min[2], grid.scale[2], grid.size[2]);
    return place + kSeedGridHeaderWords + (z * grid.size[1] + y) * grid.size[0] + x;
}

/// The place of the word that names a cell for a local position, in the grid at `place` or one
/// inside it. words.size() if there is none or a grid is corrupt; any word may be corrupt.
[[nodiscard]] inline size_t find_seed_word(std::span<const uint32_t> words, const glm::vec3& local,
                                           size_t place = 0, int level = 1) noexcept {
    for (; level <= kSeedGridLevels; ++level) {
        if (uint64_t{place} + kSeedGridHeaderWords > words.size()) break;
        const uint64_t found = seed_word(seed_grid_header(words, place), place, local);
        if (found >= words.size()) break;
        const auto word = static_cast<size_t>(found);
        if ((words[word] & kFinerGrid) == 0) return word;
        place = words[word] & ~kFinerGrid;
    }
    return words.size();
}

/// The cell for a local position whose word in the outermost grid is known: that word, or what the
/// finer grid that it names says. Any number may be corrupt.
[[nodiscard]] inline uint32_t seed_cell(std::span<const uint32_t> words, uint64_t word,
                                        const glm::vec3& local) noexcept {
    if (word >= words.size()) return 0;
    auto place = static_cast<size_t>(word);
    if ((words[place] & kFinerGrid) != 0) {
        place = find_seed_word(words, local, words[place] & ~kFinerGrid, 2);
    }
    return place < words.size() ? words[place] : 0;
}

/// For each position a cell that contains it or is near it: where a walk from the seed grid is
/// after a limited number of tests. For filling a grid. Precondition: as many cells as positions.
void find_near_cells(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
                     std::span<uint32_t> cells);

}  // namespace tetralight
