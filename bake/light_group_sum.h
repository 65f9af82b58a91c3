// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/path_light_groups.h>

namespace tetralight {

/// Sums the layers and the transfer of the samples of one estimate into the begin of a row of
/// `LightGroupLayout`, without occlusion and variances.
class LightGroupSum {
  public:
    explicit LightGroupSum(const LightGroupLayout& layout)
        : layout_(layout), sums_(layout.occlusion_begin(), 0.0) {}

    [[nodiscard]] bool is_empty() const { return sums_.empty(); }

    /// Adds a path that leaves the probe in `direction`.
    void add(glm::vec3 direction, const PathLightGroups& path, double weight);

    /// Adds radiance of one layer that arrives from `direction`. Ignored if `layer` is kNoIndex.
    void add(glm::vec3 direction, uint32_t layer, glm::vec3 radiance, double weight);

    [[nodiscard]] std::vector<float> values() const { return {sums_.begin(), sums_.end()}; }

  private:
    void add_escape(glm::vec3 direction, const PathLightGroups::Escape& escape, double weight);

    LightGroupLayout layout_;
    std::vector<double> sums_;
};

}  // namespace tetralight
