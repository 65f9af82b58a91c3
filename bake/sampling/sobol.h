// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace tetralight {

/// Point `index` of the two-dimensional Sobol sequence, Owen-scrambled by hashes of `seed` (Burley
/// 2020, "Practical Hash-based Owen Scrambling", with the permutation of Vegdahl 2021). In
/// [0, 1)². Any aligned block of 2^k indices has one point in each of its 2^k elementary intervals.
[[nodiscard]] glm::vec2 owen_sobol2(uint32_t index, uint64_t seed) noexcept;

/// The sample values of one path. Each call returns the next pair of dimensions. Over the paths 0,
/// 1, 2... of one key, each pair is a randomized low-discrepancy sequence (padded Sobol points with
/// shuffled indices: Burley 2020, section 5). A pure function of (key, path, number of earlier
/// calls).
class Sampler {
  public:
    Sampler(uint64_t key, uint32_t path) noexcept;

    /// Uniform in [0, 1)².
    [[nodiscard]] glm::vec2 next2() noexcept;

    /// The first dimension of the next pair, uniform in [0, 1).
    [[nodiscard]] float next() noexcept;

    /// Skips a pair of dimensions.
    void skip() noexcept;

    /// A sampler of the same path whose values are independent of those of this one.
    [[nodiscard]] Sampler branch() const noexcept;

    /// Uniform in [0, 1) with 48 bits, to select one of many items. Takes one pair.
    [[nodiscard]] double next_double() noexcept;

  private:
    /// Index into the Sobol sequence and scrambling seed of one pair.
    struct Pair {
        uint32_t index;
        uint64_t seed;
    };

    Pair next_pair() noexcept;

    uint64_t key_;
    uint32_t reversed_path_;  ///< its bits, the last one first
};

}  // namespace tetralight
