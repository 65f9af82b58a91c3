// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bake/emitter_bounds.h"
#include "probes/no_index.h"

namespace tetralight {

/// Who receives light: a position and, for surfaces, a unit normal; zero = from everywhere.
struct Receiver {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
};

/// Draws one of many emitters about as often as its light at a receiver is of all light there, in
/// logarithmic time: a binary tree of bounds, in which each turn is drawn by importance, an
/// estimate of what leaves the bounds and reaches the receiver, shadows left out. It is positive
/// unless they can send nothing. (Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights
/// with Adaptive Tree Splitting", section 4.)
class LightTree {
  public:
    struct Choice {
        uint32_t emitter = kNoIndex;  ///< number in what the tree was made of
        float probability = 0.0f;
    };

    LightTree() = default;

    /// Emitters without power are never drawn.
    explicit LightTree(std::span<const EmitterBounds> emitters);

    [[nodiscard]] bool is_empty() const { return nodes_.empty(); }

    /// The emitter for `u` uniform in [0, 1); none when the turns lead to emitters of no use here.
    [[nodiscard]] std::optional<Choice> sample(const Receiver& receiver, double u) const noexcept;

    /// Probability with which `sample` draws an emitter. The sum over all is at most 1.
    [[nodiscard]] float probability(const Receiver& receiver, uint32_t emitter) const noexcept;

  private:
    /// Bounds in the form in which importance is found fastest, within one cache line.
    struct Node {
        glm::vec3 center{0.0f};
        float radius2 = 0.0f;  ///< of the sphere around the box
        glm::vec3 axis{0.0f};
        float cos_axes = 0.0f, sin_axes = 0.0f, cos_emission = 0.0f;
        float power = 0.0f;
        float reach2 = 0.0f;          ///< of the center
        uint32_t second = 0;          ///< second child; the first follows its parent
        uint32_t emitter = kNoIndex;  ///< of a leaf
    };

    static_assert(sizeof(Node) <= 64);

    static Node make_node(const EmitterBounds& bounds, uint32_t second, uint32_t emitter);
    static float importance(const Node& node, const Receiver& receiver) noexcept;

    /// Share of the draws at a node that turn to its first child; negative where neither is of use.
    [[nodiscard]] double first_share(uint32_t node, const Receiver& receiver) const noexcept;

    struct Item;
    class Builder;

    /// The way from the root to a leaf, first turn in the lowest bit: 1 = second child.
    std::vector<uint64_t> turns_;
    std::vector<Node> nodes_;
};

}  // namespace tetralight
