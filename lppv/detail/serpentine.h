// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// Visits the points of boxes so that consecutive points are neighbors: back and forth along z,
/// then y, then x. Each box begins at the sides where the previous box ended.
class Serpentine {
  public:
    /// Calls visit(point) for each point of the box [0, size).
    template <class Visit>
    void walk(const glm::uvec3& size, Visit&& visit) {
        for (uint32_t i = 0; i < size.x; ++i) {
            for (uint32_t j = 0; j < size.y; ++j) {
                for (uint32_t k = 0; k < size.z; ++k) {
                    visit(glm::uvec3(is_back_x_ ? size.x - 1 - i : i,
                                     is_back_y_ ? size.y - 1 - j : j,
                                     is_back_z_ ? size.z - 1 - k : k));
                }
                is_back_z_ = !is_back_z_;
            }
            is_back_y_ = !is_back_y_;
        }
        is_back_x_ = !is_back_x_;
    }

  private:
    bool is_back_x_ = false, is_back_y_ = false, is_back_z_ = false;
};

}  // namespace tetralight::detail
