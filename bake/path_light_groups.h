// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// The light of one path by source: radiance per layer, and the segment with which the path escaped
/// from the scene. Reused from path to path, to avoid allocations.
class PathLightGroups {
  public:
    explicit PathLightGroups(uint32_t layer_count)
        : direct_(layer_count, glm::vec3(0.0f)), reflected_(layer_count, glm::vec3(0.0f)) {}

    /// How light arrives at the probe: along the first segment of the path, or by reflections.
    enum class Arrival : bool { Direct, Reflected };

    /// The ray that escaped, and the throughput of the path up to it. Black if no ray escaped.
    struct Escape {
        glm::vec3 direction{0.0f};
        glm::vec3 throughput{0.0f};
        /// The first segment of the path escaped.
        bool is_direct = false;
    };

    void clear() {
        std::ranges::fill(direct_, glm::vec3(0.0f));
        std::ranges::fill(reflected_, glm::vec3(0.0f));
        escape_ = {};
    }

    /// Adds radiance of a layer. Ignored if `layer` is kNoIndex.
    void add(uint32_t layer, glm::vec3 radiance, Arrival arrival) {
        if (layer >= direct_.size()) return;
        (arrival == Arrival::Direct ? direct_ : reflected_)[layer] += radiance;
    }

    void set_escape(const Escape& escape) { escape_ = escape; }

    /// Applies the factor of a clamp to the reflected light.
    void scale_reflected(float factor) {
        for (glm::vec3& radiance : reflected_) radiance *= factor;
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
