// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// Evenly distributed directions over the sphere (`spherical_fibonacci`), ordered along a Hilbert
/// curve so that consecutive directions are neighbors. Consecutive paths have well-distributed
/// sample values (`Sampler`), so that paths that start into the same part of the sphere leave the
/// surfaces there into different directions.
class DirectionSet {
  public:
    /// Larger sets keep the order of the lattice and are not stored: they are dense enough without
    /// it.
    static constexpr uint32_t kMaxOrderedCount = 65536;

    /// Precondition: `count` > 0.
    explicit DirectionSet(uint32_t count);

    [[nodiscard]] uint32_t size() const { return count_; }

    [[nodiscard]] glm::vec3 operator[](uint32_t i) const noexcept;

  private:
    uint32_t count_;
    std::vector<glm::vec3> ordered_;
};

}  // namespace tetralight
