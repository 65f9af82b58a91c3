// SPDX-License-Identifier: Apache-2.0
#include "bake/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/assert.h"

namespace tetralight {
namespace {

/// Rounding of a cosine; what is this near to its limit counts as within it.
constexpr float kSlack = 1e-4f;

/// Importance never falls below this share for being slanted, so that no sample weighs too much.
constexpr float kLeastCosine = 0.01f;

float sine_of(float cosine) {
    return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

/// An angle by its cosine and sine.
struct Angle {
    float cosine;
    float sine;
};

/// max(0, a − b)
Angle difference(Angle a, Angle b) {
    if (a.cosine > b.cosine) return {1.0f, 0.0f};
    return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

}  // namespace

LightTree::Node LightTree::make_node(const EmitterBounds& bounds, uint32_t second,
                                     uint32_t emitter) {
    Node node;
    const glm::vec3 half_size = 0.5f * (bounds.high - bounds.low);
    node.center = bounds.low + half_size;
    node.radius2 = glm::dot(half_size, half_size);
    node.axis = bounds.axis;
    node.cos_axes = bounds.cos_axes;
    node.sin_axes = sine_of(bounds.cos_axes);
    node.cos_emission = bounds.cos_emission;
    node.power = bounds.power;
    const float reach = bounds.reach + glm::length(half_size);
    node.reach2 = reach * reach * (1.0f + kSlack);
    node.second = second;
    node.emitter = emitter;
    return node;
}

float LightTree::importance(const Node& node, const Receiver& receiver) noexcept {
    const glm::vec3 offset = receiver.position - node.center;
    const float distance2 = glm::dot(offset, offset);
    if (distance2 > node.reach2) return 0.0f;
    // Near the box any direction is possible, and distance means little.
    if (distance2 <= node.radius2) return node.power / std::max(node.radius2, 1e-30f);

    const float inverse = 1.0f / distance2;
    const glm::vec3 from_light = offset * std::sqrt(inverse);
    const float sin2_box = node.radius2 * inverse;
    const Angle box{std::sqrt(std::max(0.0f, 1.0f - sin2_box)), std::sqrt(sin2_box)};
    float result = node.power * inverse;
    if (node.cos_axes > -1.0f) {
        const float cosine = glm::dot(node.axis, from_light);
        const Angle to_axes = difference({cosine, sine_of(cosine)}, {node.cos_axes, node.sin_axes});
        const float leaving = difference(to_axes, box).cosine;
        if (leaving < node.cos_emission - kSlack) return 0.0f;
        result *= std::max(leaving, kLeastCosine);
    }
    if (receiver.normal != glm::vec3(0.0f)) {
        const float cosine = -glm::dot(receiver.normal, from_light);
        const float arriving = difference({cosine, sine_of(cosine)}, box).cosine;
        if (arriving < -kSlack) return 0.0f;
        result *= std::max(arriving, kLeastCosine);
    }
    return result;
}

struct LightTree::Item {
    uint32_t emitter;
    EmitterBounds bounds;
    glm::vec3 center;
};

/// Splits emitters in two by the smallest cost, over twelve slices of each axis, until each is
/// alone (pbrt-4, BVHLightSampler::buildBVH).
class LightTree::Builder {
  public:
    explicit Builder(LightTree& tree) : tree_(tree) {}

    void build(std::span<Item> items, uint64_t turns, uint32_t depth) {
        const size_t node = tree_.nodes_.size();
        tree_.nodes_.emplace_back();
        if (items.size() == 1) {
            tree_.nodes_[node] = make_node(items[0].bounds, 0, items[0].emitter);
            tree_.turns_[items[0].emitter] = turns;
            return;
        }
        EmitterBounds bounds;
        for (const Item& item : items) bounds = united(bounds, item.bounds);
        const size_t first_count = split(items, depth);
        build(items.first(first_count), turns, depth + 1);
        const auto second = static_cast<uint32_t>(tree_.nodes_.size());
        build(items.subspan(first_count), turns | uint64_t{1} << depth, depth + 1);
        tree_.nodes_[node] = make_node(bounds, second, kNoIndex);
    }

  private:
    static constexpr int kSlices = 12;
    /// From here on halves have the same number of emitters, so that 2^32 fit into 64 turns.
    static constexpr uint32_t kBalancedDepth = 32;

    struct Split {
        float cost = std::numeric_limits<float>::infinity();
        int axis = -1;
        int slice = 0;
    };

    /// Sorts the items in two and returns how many are in the first part.
    static size_t split(std::span<Item> items, uint32_t depth) {
        glm::vec3 low = items[0].center, high = low;
        for (const Item& item : items) {
            low = glm::min(low, item.center);
            high = glm::max(high, item.center);
        }
        Split best;
        if (depth < kBalancedDepth) {
            for (int axis = 0; axis < 3; ++axis) try_axis(items, axis, low, high, best);
        }
        if (best.axis < 0) return halve(items, low, high);
        const auto middle = std::stable_partition(
            items.begin(), items.end(),
            [&](const Item& item) { return slice_of(item, best.axis, low, high) <= best.slice; });
        return static_cast<size_t>(middle - items.begin());
    }

    static int slice_of(const Item& item, int axis, glm::vec3 low, glm::vec3 high) {
        const float share = (item.center[axis] - low[axis]) / (high[axis] - low[axis]);
        return std::min(static_cast<int>(share * kSlices), kSlices - 1);
    }

    static void try_axis(std::span<const Item> items, int axis, glm::vec3 low, glm::vec3 high,
                         Split& best) {
        const glm::vec3 size = high - low;
        if (!(size[axis] > 0.0f)) return;
        std::array<EmitterBounds, kSlices> slices;
        for (const Item& item : items) {
            EmitterBounds& slice = slices[slice_of(item, axis, low, high)];
            slice = united(slice, item.bounds);
        }
        std::array<EmitterBounds, kSlices> after;  // all slices beyond one
        for (int i = kSlices - 2; i >= 0; --i) after[i] = united(after[i + 1], slices[i + 1]);
        EmitterBounds before;
        // Long thin boxes are cut across.
        const float shape = std::max({size.x, size.y, size.z}) / size[axis];
        for (int i = 0; i < kSlices - 1; ++i) {
            before = united(before, slices[i]);
            if (before.power <= 0.0f || after[i].power <= 0.0f) continue;
            const float cost = shape * (split_cost(before) + split_cost(after[i]));
            if (cost < best.cost) best = {cost, axis, i};
        }
    }

    static size_t halve(std::span<Item> items, glm::vec3 low, glm::vec3 high) {
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        std::stable_sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
            return a.center[axis] < b.center[axis];
        });
        return items.size() / 2;
    }

    LightTree& tree_;
};

LightTree::LightTree(std::span<const EmitterBounds> emitters) : turns_(emitters.size()) {
    TETRALIGHT_ASSERT(emitters.size() < kNoIndex, "emitters are counted in 32 bits");
    std::vector<Item> items;
    for (uint32_t i = 0; i < emitters.size(); ++i) {
        const EmitterBounds& e = emitters[i];
        if (e.power > 0.0f) items.push_back({i, e, 0.5f * (e.low + e.high)});
    }
    if (items.empty()) return;
    nodes_.reserve(2 * items.size() - 1);
    Builder(*this).build(items, 0, 0);
}

double LightTree::first_share(uint32_t node, const Receiver& receiver) const noexcept {
    const double first = importance(nodes_[node + 1], receiver);
    const double second = importance(nodes_[nodes_[node].second], receiver);
    return first + second > 0.0 ? first / (first + second) : -1.0;
}

std::optional<LightTree::Choice> LightTree::sample(const Receiver& receiver,
                                                   double u) const noexcept {
    if (nodes_.empty()) return std::nullopt;
    uint32_t node = 0;
    double probability = 1.0;
    while (nodes_[node].emitter == kNoIndex) {
        const double share = first_share(node, receiver);
        if (share < 0.0) return std::nullopt;
        if (u < share) {
            u /= share;
            probability *= share;
            node = node + 1;
        } else {
            u = (u - share) / (1.0 - share);
            probability *= 1.0 - share;
            node = nodes_[node].second;
        }
    }
    return Choice{nodes_[node].emitter, static_cast<float>(probability)};
}

float LightTree::probability(const Receiver& receiver, uint32_t emitter) const noexcept {
    double probability = 1.0;
    uint64_t turns = turns_[emitter];
    uint32_t node = 0;
    while (node < nodes_.size() && nodes_[node].emitter == kNoIndex) {
        const double share = first_share(node, receiver);
        if (share < 0.0) return 0.0f;
        const bool takes_second = (turns & 1) != 0;
        probability *= takes_second ? 1.0 - share : share;
        node = takes_second ? nodes_[node].second : node + 1;
        turns >>= 1;
    }
    const bool is_found = node < nodes_.size() && nodes_[node].emitter == emitter;
    return is_found ? static_cast<float>(probability) : 0.0f;
}

}  // namespace tetralight
