// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// Directions that are spread evenly over the sphere (`spherical_fibonacci`), in an order in which
/// those that follow each other lie side by side, along a Hilbert curve. Paths are numbered so, and
/// each few in turn have random numbers that cover their square evenly (`Sampler`): those that
/// leave into the same part of the sphere then leave its surfaces into different ones.
class DirectionSet {
  public:
    /// Sets larger than this keep the lattice's own order and are not stored: they are even enough.
    static constexpr uint32_t kMaxOrderedCount = 65536;

    /// Precondition: at least one.
    explicit DirectionSet(uint32_t count);

    [[nodiscard]] uint32_t size() const { return count_; }

    [[nodiscard]] glm::vec3 operator[](uint32_t i) const noexcept;

  private:
    uint32_t count_;
    std::vector<glm::vec3> ordered_;
};

}  // namespace tetralight
