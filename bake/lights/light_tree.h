// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/lights/detail/float4.h>
#include <tetralight/bake/lights/light_bounds.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

/// A position that receives light, with the unit normal of its surface; a zero normal = light from
/// all directions counts.
struct ShadingPoint {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
};

/// Samples one of many lights with a probability roughly in proportion to its light at a shading
/// point, in logarithmic time. A tree of light bounds: on the way down, a child is chosen by its
/// importance, an estimate of the light that leaves its bounds and arrives at the shading point,
/// without shadows. The importance is positive unless no light can arrive. (Conty Estevez & Kulla
/// 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", section 4.)
class LightTree {
  public:
    struct SampledLight {
        uint32_t light = kNoIndex;  ///< index into the lights of the constructor
        float probability = 0.0f;
    };

    LightTree() = default;

    /// Lights without power are never sampled.
    explicit LightTree(std::span<const LightBounds> lights);

    [[nodiscard]] bool is_empty() const { return nodes_.empty(); }

    /// The light for `u` uniform in [0, 1); none if no light of the chosen subtree can light the
    /// shading point.
    [[nodiscard]] std::optional<SampledLight> sample(const ShadingPoint& shading_point,
                                                     double u) const noexcept;

    /// Probability with which `sample` samples a light. The sum over all is at most 1.
    [[nodiscard]] float probability(const ShadingPoint& shading_point,
                                    uint32_t light) const noexcept;

  private:
    static constexpr uint32_t kLanes = 4;

    using Lanes = detail::Float4;

    /// Four children in structure-of-arrays layout: their importances are evaluated together.
    struct Node {
        Lanes center_x{}, center_y{}, center_z{};
        Lanes radius{};  ///< of the bounding sphere of the box
        Lanes axis_x{}, axis_y{}, axis_z{};
        Lanes cos_theta_o{}, sin_theta_o{}, cos_theta_e{};
        Lanes back{};                          ///< −1: two-sided; 1: one-sided
        Lanes power{};                         ///< 0 = no child
        Lanes max_distance{};                  ///< from the center of the box
        std::array<uint32_t, kLanes> child{};  ///< index of a node, or of a light for a leaf
        std::array<bool, kLanes> is_leaf{};
    };

    static void set_lane(Node& node, uint32_t lane, const LightBounds& bounds);
    static detail::Float4 importance(const Node& node, const ShadingPoint& shading_point) noexcept;

    struct Item;
    class Builder;

    /// The bit trail of each light: its lanes on the way from the root, two bits each, the first in
    /// the lowest bits.
    std::vector<uint64_t> bit_trails_;
    std::vector<Node> nodes_;
};

}  // namespace tetralight
