// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/light_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/base/contract.h>

namespace tetralight {

using detail::splat, detail::Float4, detail::max4, detail::min4, detail::sqrt4;

namespace {

/// Tolerance of cosines and distances against rounding.
constexpr float kSlack = 1e-4f;

/// Lower limit of each cosine factor of the importance, which bounds the weight of a sample.
constexpr float kMinCosine = 0.01f;

/// Upper limit of an importance, so that sums stay finite.
constexpr float kMaxImportance = 1e30f;

float sine_of(float cosine) {
    return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

Float4 sine_of(Float4 cosine) {
    return sqrt4(max4(splat(1.0f) - cosine * cosine, splat(0.0f)));
}

}  // namespace

void LightTree::set_lane(Node& node, uint32_t lane, const LightBounds& bounds) {
    const glm::vec3 half_size = 0.5f * (bounds.max - bounds.min);
    const glm::vec3 center = bounds.min + half_size;
    node.center_x[lane] = center.x;
    node.center_y[lane] = center.y;
    node.center_z[lane] = center.z;
    node.radius[lane] = glm::length(half_size);
    node.axis_x[lane] = bounds.axis.x;
    node.axis_y[lane] = bounds.axis.y;
    node.axis_z[lane] = bounds.axis.z;
    // A cone of all directions contains every direction in spite of rounding.
    node.cos_theta_o[lane] = bounds.cos_theta_o > -1.0f ? bounds.cos_theta_o : -2.0f;
    node.sin_theta_o[lane] = sine_of(bounds.cos_theta_o);
    node.cos_theta_e[lane] = bounds.cos_theta_e - kSlack;
    node.back[lane] = bounds.is_two_sided ? -1.0f : 1.0f;
    node.power[lane] = bounds.power;
    node.max_distance[lane] = (bounds.max_distance + glm::length(half_size)) * (1.0f + kSlack);
}

/// Branch-free importance of four children (Conty Estevez & Kulla 2018, section 4). Angles are kept
/// as cosine and sine: cos max(0, a − b) is 1 if cos a > cos b, else cos a cos b + sin a sin b.
detail::Float4 LightTree::importance(const Node& node, const ShadingPoint& shading_point) noexcept {
    const glm::vec3 position = shading_point.position, normal = shading_point.normal;
    const Float4 x = splat(position.x) - node.center_x;
    const Float4 y = splat(position.y) - node.center_y;
    const Float4 z = splat(position.z) - node.center_z;
    const Float4 distance = sqrt4(x * x + y * y + z * z);
    const Float4 inverse = splat(1.0f) / distance;
    const Float4 radius = node.radius;
    const Float4 sin_box = min4(radius * inverse, splat(1.0f));
    const Float4 cos_box = sine_of(sin_box);

    const Float4 axis = node.axis_x * x + node.axis_y * y + node.axis_z * z;
    const Float4 ahead = axis * inverse;
    const Float4 cos_out = max4(ahead, ahead * node.back);
    const Float4 sin_out = sine_of(cos_out);
    const Float4 cone_cos = node.cos_theta_o, cone_sin = node.sin_theta_o;
    const Float4 cos_theta_o = cos_out * cone_cos + sin_out * cone_sin;
    const Float4 sin_theta_o = sin_out * cone_cos - cos_out * cone_sin;
    const Float4 off_axes = cos_theta_o * cos_box + sin_theta_o * sin_box;
    const auto is_ahead = (cos_out > cone_cos) | (cos_theta_o > cos_box);
    const Float4 leaving = is_ahead ? splat(1.0f) : off_axes;

    Float4 arriving = splat(1.0f);
    if (normal != glm::vec3(0.0f)) {
        const Float4 height = splat(-normal.x) * x + splat(-normal.y) * y + splat(-normal.z) * z;
        const Float4 cos_in = height * inverse;
        const Float4 off_normal = cos_in * cos_box + sine_of(cos_in) * sin_box;
        arriving = cos_in > cos_box ? splat(1.0f) : off_normal;
    }
    const Float4 least = splat(kMinCosine), power = node.power;
    const Float4 slanted = max4(leaving, least) * max4(arriving, least);
    const auto is_useful = (distance <= node.max_distance) & (leaving >= node.cos_theta_e) &
                           (arriving >= splat(-kSlack));
    const Float4 afar = is_useful ? power * inverse * inverse * slanted : splat(0.0f);
    // Within the bounding sphere, neither direction nor distance is bounded in a useful way.
    const Float4 size = max4(radius, splat(1e-15f));
    const Float4 nearby = power / (size * size);
    return min4(distance > radius ? afar : nearby, splat(kMaxImportance));
}

struct LightTree::Item {
    uint32_t light;
    LightBounds bounds;
    glm::vec3 center;
};

/// Splits the lights in two at the smallest cost over twelve buckets per axis, down to single
/// lights (pbrt-4, BVHLightSampler::buildBVH). Two levels of splits make one node of four children.
class LightTree::Builder {
  public:
    explicit Builder(LightTree& tree) : tree_(tree) {}

    /// Builds the node of the items, whose bit trail has `depth` bits so far, and returns its
    /// index.
    uint32_t build(std::span<Item> items, uint64_t bit_trail, uint32_t depth) {
        const auto index = static_cast<uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        if (items.size() == 1) {
            add_lane(index, 0, items, bit_trail, depth);
            return index;
        }
        const size_t first_count = split(items, depth);
        add_half(index, 0, items.first(first_count), bit_trail, depth);
        add_half(index, 2, items.subspan(first_count), bit_trail, depth);
        return index;
    }

  private:
    /// Fills two lanes, or one if there is a single item.
    void add_half(uint32_t node, uint32_t lane, std::span<Item> items, uint64_t bit_trail,
                  uint32_t depth) {
        if (items.size() == 1) return add_lane(node, lane, items, bit_trail, depth);
        const size_t first_count = split(items, depth + 1);
        add_lane(node, lane, items.first(first_count), bit_trail, depth);
        add_lane(node, lane + 1, items.subspan(first_count), bit_trail, depth);
    }

    void add_lane(uint32_t node, uint32_t lane, std::span<Item> items, uint64_t bit_trail,
                  uint32_t depth) {
        bit_trail |= uint64_t{lane} << depth;
        LightBounds bounds;
        for (const Item& item : items) bounds = union_of(bounds, item.bounds);
        const bool is_leaf = items.size() == 1;
        const uint32_t light = items[0].light;
        if (is_leaf) tree_.bit_trails_[light] = bit_trail;
        const uint32_t child = is_leaf ? light : build(items, bit_trail, depth + 2);
        set_lane(tree_.nodes_[node], lane, bounds);
        tree_.nodes_[node].child[lane] = child;
        tree_.nodes_[node].is_leaf[lane] = is_leaf;
    }

    static constexpr int kBuckets = 12;
    /// From this depth on, splits halve the number of lights, so that the bit trails of 2^32 lights
    /// fit into 64 bits.
    static constexpr uint32_t kBalancedDepth = 32;

    struct Split {
        float cost = std::numeric_limits<float>::infinity();
        int axis = -1;
        int bucket = 0;
    };

    /// Partitions the items in two and returns the size of the first part.
    static size_t split(std::span<Item> items, uint32_t depth) {
        glm::vec3 min = items[0].center, max = min;
        for (const Item& item : items) {
            min = glm::min(min, item.center);
            max = glm::max(max, item.center);
        }
        Split best;
        if (depth < kBalancedDepth) {
            for (int axis = 0; axis < 3; ++axis) try_axis(items, axis, min, max, best);
        }
        if (best.axis < 0) return halve(items, min, max);
        const auto second = std::stable_partition(
            items.begin(), items.end(),
            [&](const Item& item) { return bucket_of(item, best.axis, min, max) <= best.bucket; });
        return static_cast<size_t>(second - items.begin());
    }

    static int bucket_of(const Item& item, int axis, glm::vec3 min, glm::vec3 max) {
        const float fraction = (item.center[axis] - min[axis]) / (max[axis] - min[axis]);
        return std::min(static_cast<int>(fraction * kBuckets), kBuckets - 1);
    }

    static void try_axis(std::span<const Item> items, int axis, glm::vec3 min, glm::vec3 max,
                         Split& best) {
        const glm::vec3 size = max - min;
        if (!(size[axis] > 0.0f)) return;
        std::array<LightBounds, kBuckets> buckets;
        for (const Item& item : items) {
            LightBounds& bucket = buckets[bucket_of(item, axis, min, max)];
            bucket = union_of(bucket, item.bounds);
        }
        std::array<LightBounds, kBuckets> after;  // union of all later buckets
        for (int i = kBuckets - 2; i >= 0; --i) after[i] = union_of(after[i + 1], buckets[i + 1]);
        LightBounds before;
        // Favors splits across the longest axis.
        const float shape = std::max({size.x, size.y, size.z}) / size[axis];
        for (int i = 0; i < kBuckets - 1; ++i) {
            before = union_of(before, buckets[i]);
            if (before.power <= 0.0f || after[i].power <= 0.0f) continue;
            const float cost = shape * (split_cost(before) + split_cost(after[i]));
            if (cost < best.cost) best = {cost, axis, i};
        }
    }

    /// Sorts the items along the longest axis, and returns half of their number.
    static size_t halve(std::span<Item> items, glm::vec3 min, glm::vec3 max) {
        const glm::vec3 size = max - min;
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        std::stable_sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
            return a.center[axis] < b.center[axis];
        });
        return items.size() / 2;
    }

    LightTree& tree_;
};

LightTree::LightTree(std::span<const LightBounds> lights) : bit_trails_(lights.size()) {
    TETRALIGHT_ASSERT(lights.size() < kNoIndex, "lights are counted in 32 bits");
    std::vector<Item> items;
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const LightBounds& bounds = lights[i];
        if (bounds.power > 0.0f) items.push_back({i, bounds, 0.5f * (bounds.min + bounds.max)});
    }
    if (items.empty()) return;
    Builder(*this).build(items, 0, 0);
}

std::optional<LightTree::SampledLight> LightTree::sample(const ShadingPoint& shading_point,
                                                         double u) const noexcept {
    if (nodes_.empty()) return std::nullopt;
    double probability = 1.0;
    for (uint32_t node = 0;;) {
        const Float4 importances = importance(nodes_[node], shading_point);
        const float total = (importances[0] + importances[1]) + (importances[2] + importances[3]);
        if (!(total > 0.0f)) return std::nullopt;
        double rest = u * total;
        uint32_t lane = kNoIndex;  // the last positive one, if rounding passes them all
        for (uint32_t i = 0; i < kLanes; ++i) {
            if (!(importances[i] > 0.0f)) continue;
            if (lane != kNoIndex) rest -= importances[lane];
            lane = i;
            if (rest < importances[i]) break;
        }
        const double chosen = importances[lane];
        u = std::clamp(rest / chosen, 0.0, 1.0);
        probability *= chosen / total;
        if (nodes_[node].is_leaf[lane]) {
            return SampledLight{nodes_[node].child[lane], static_cast<float>(probability)};
        }
        node = nodes_[node].child[lane];
    }
}

float LightTree::probability(const ShadingPoint& shading_point, uint32_t light) const noexcept {
    if (nodes_.empty()) return 0.0f;
    double probability = 1.0;
    uint64_t bit_trail = bit_trails_[light];
    for (uint32_t node = 0;; bit_trail >>= 2) {
        const Float4 importances = importance(nodes_[node], shading_point);
        const float total = (importances[0] + importances[1]) + (importances[2] + importances[3]);
        if (!(total > 0.0f)) return 0.0f;
        const uint32_t lane = bit_trail & 3;
        probability *= static_cast<double>(importances[lane]) / total;
        if (nodes_[node].is_leaf[lane]) {
            const bool is_found = nodes_[node].child[lane] == light;
            return is_found ? static_cast<float>(probability) : 0.0f;
        }
        node = nodes_[node].child[lane];
    }
}

}  // namespace tetralight
