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
        : direct_(layer_count, glm::vec3(0.0f)), reflected_(layer_count, glm::vec3(0.0f)) {}

    /// Where a path left the scene, and the share of the light from there that it brings.
    struct Escape {
        glm::vec3 direction{0.0f};
        glm::vec3 throughput{0.0f};
        /// It met no surface before.
        bool is_direct = false;
    };

    void clear() {
        std::ranges::fill(direct_, glm::vec3(0.0f));
        std::ranges::fill(reflected_, glm::vec3(0.0f));
        escape_ = {};
    }

    enum class Arrival : bool { Direct, Reflected };

    /// Light of a layer; those that are no layer are left out.
    void add(uint32_t layer, glm::vec3 light, Arrival arrival) {
        if (layer < direct_.size())
            (arrival == Arrival::Direct ? direct_ : reflected_)[layer] += light;
    }

    void set_escape(const Escape& escape) { escape_ = escape; }

    /// What a clamp does to the whole.
    void scale_reflected(float factor) {
        for (glm::vec3& light : reflected_) light *= factor;
    }

    [[nodiscard]] uint32_t layer_count() const { return static_cast<uint32_t>(direct_.size()); }

    [[nodiscard]] glm::vec3 radiance(uint32_t layer) const {
        return direct_[layer] + reflected_[layer];
    }

    [[nodiscard]] const Escape& escape() const { return escape_; }

  private:
    std::vector<glm::vec3> direct_;
    std::vector<glm::vec3> reflected_;
    Escape escape_;
};

}  // namespace tetralight
