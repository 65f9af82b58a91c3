// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace tetralight::detail {

/// Allocates boxes in a larger box without overlap: it cuts the smallest free box that is large
/// enough (guillotine packing). Deterministic.
class BoxPacking {
  public:
    explicit BoxPacking(glm::uvec3 size);

    /// The minimum corner of a new box of this size, or none if no free box is large enough.
    /// Precondition: no side is 0.
    [[nodiscard]] std::optional<glm::uvec3> allocate(glm::uvec3 size);

    /// Frees an allocated box.
    void release(glm::uvec3 min, glm::uvec3 size);

    /// Number of allocated texels, and of all texels.
    [[nodiscard]] uint64_t used() const noexcept { return used_; }

    [[nodiscard]] uint64_t capacity() const noexcept;

  private:
    struct Box {
        glm::uvec3 min;
        glm::uvec3 size;

        [[nodiscard]] uint64_t volume() const { return uint64_t{size.x} * size.y * size.z; }
    };

    [[nodiscard]] static bool join(Box& box, const Box& other);
    void cut(Box box, glm::uvec3 size);

    glm::uvec3 size_;
    std::vector<Box> free_;
    uint64_t used_ = 0;
};

}  // namespace tetralight::detail
