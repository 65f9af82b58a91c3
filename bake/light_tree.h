// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/emitter_bounds.h"
#include "probes/no_index.h"

namespace tetralight {

/// Draws one of many emitters about as often as its light at a receiver is of all light there, in
/// logarithmic time: a binary tree of bounds, in which each turn is drawn by importance.
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
    struct Node {
        EmitterBounds bounds;
        uint32_t second = 0;          ///< second child; the first follows its parent
        uint32_t emitter = kNoIndex;  ///< of a leaf
    };

    struct Item;
    class Builder;

    /// The way from the root to a leaf, first turn in the lowest bit: 1 = second child.
    std::vector<uint64_t> turns_;
    std::vector<Node> nodes_;
};

}  // namespace tetralight
