// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tetralight::detail {

/// Finds positions by their exact value.
class PositionTable {
  public:
    /// The positions must be distinct, and stay where they are as long as the table is used.
    explicit PositionTable(std::span<const glm::dvec3> positions);

    /// The index of a position, or kNoIndex.
    [[nodiscard]] uint32_t find(const glm::dvec3& position) const;

  private:
    [[nodiscard]] size_t last_slot() const { return slots_.size() - 1; }

    std::span<const glm::dvec3> positions_;
    std::vector<uint32_t> slots_;  // a power of two, at most half of them in use
};

}  // namespace tetralight::detail
