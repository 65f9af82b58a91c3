// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// Where the light of one path came from, beside the sum of it all. Reused from path to path.
class PathLightGroups {
  public:
    explicit PathLightGroups(uint32_t layer_count)
        : seen_(layer_count, glm::vec3(0.0f)), reflected_(layer_count, glm::vec3(0.0f)) {}

    /// Where a path left the scene, and the share of the light from there that it brings.
    struct Exit {
        glm::vec3 direction{0.0f};
        glm::vec3 throughput{0.0f};
        /// It met no surface before.
        bool is_direct = false;
    };

    void clear() {
        std::ranges::fill(seen_, glm::vec3(0.0f));
        std::ranges::fill(reflected_, glm::vec3(0.0f));
        exit_ = {};
    }

    enum class Way : bool { Seen, Reflected };

    /// Light of a layer; those that are no layer are left out.
    void add(uint32_t layer, glm::vec3 light, Way way) {
        if (layer < seen_.size()) (way == Way::Seen ? seen_ : reflected_)[layer] += light;
    }

    void leave(const Exit& exit) { exit_ = exit; }

    /// What a clamp does to the whole.
    void scale_reflected(float factor) {
        for (glm::vec3& light : reflected_) light *= factor;
    }

    [[nodiscard]] uint32_t layer_count() const { return static_cast<uint32_t>(seen_.size()); }

    [[nodiscard]] glm::vec3 radiance(uint32_t layer) const {
        return seen_[layer] + reflected_[layer];
    }

    [[nodiscard]] const Exit& exit() const { return exit_; }

  private:
    std::vector<glm::vec3> seen_;
    std::vector<glm::vec3> reflected_;
    Exit exit_;
};

}  // namespace tetralight
