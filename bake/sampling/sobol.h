// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace tetralight {

/// Point `index` of the two-dimensional Sobol sequence, Owen-scrambled by hashes of `seed` (Burley
/// 2020, "Practical Hash-based Owen Scrambling", with the permutation of Vegdahl 2021). In
/// [0, 1)². Any aligned block of 2^k indices has one point in each of its 2^k elementary intervals.
[[nodiscard]] glm::vec2 owen_sobol2(uint32_t index, uint64_t seed) noexcept;

/// The random numbers of one path out of many that are averaged: each call takes the next pair of
/// dimensions, and over the paths 0, 1, 2... of one key the numbers of each pair cover the square
/// evenly (padded Sobol points with shuffled indices: Burley 2020, section 5). A pure function of
/// (key, path, number of calls before).
class Sampler {
  public:
    Sampler(uint64_t key, uint32_t path) noexcept;

    /// Uniform in [0, 1)².
    [[nodiscard]] glm::vec2 next2() noexcept;

    /// The first of the next pair.
    [[nodiscard]] float next() noexcept;

    /// Passes over a pair that is of no use.
    void skip() noexcept;

    /// Uniform in [0, 1) with 48 bits, for choices among many. Takes one pair.
    [[nodiscard]] double next_double() noexcept;

  private:
    /// Index and scrambling of the next pair.
    struct Place {
        uint32_t index;
        uint64_t seed;
    };

    Place next_place() noexcept;

    uint64_t key_;
    uint32_t reversed_path_;  ///< its bits, the last one first
};

}  // namespace tetralight
