// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/prefilter_cube.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>
#include <tetralight/reflection/reflections.h>

namespace tetralight {
namespace {

/// A square of texels of a face is summed as one if its radius is at most this share of the angle
/// over which the lobe changes. Errors of the levels are below 1 % (bench reflection).
constexpr float kLargestShare = 0.2f;

/// A square of 2^k × 2^k texels of a face.
struct Node {
    glm::vec3 direction{0.0f};  ///< to its center, unit
    float solid_angle = 0.0f;
    glm::vec3 light{0.0f};            ///< radiance times solid angle
    float radius = 0.0f;              ///< angle from the center to the farthest corner
    glm::vec3 light_direction{0.0f};  ///< to the center of its light, unit
};

/// The quadtrees of the six faces: level 0 has the texels, the last one a node a face.
class CubeTree {
  public:
    explicit CubeTree(const CubeImage& cube) {
        levels_.push_back(leaves(cube));
        for (uint32_t size = cube.size / 2; size > 0; size /= 2) {
            levels_.push_back(parents(levels_.back(), size));
        }
    }

    [[nodiscard]] uint32_t level_count() const { return static_cast<uint32_t>(levels_.size()); }

    [[nodiscard]] uint32_t size(uint32_t level) const { return 1u << (level_count() - 1 - level); }

    [[nodiscard]] const Node& node(uint32_t level, const CubeTexel& place) const {
        return levels_[level][index(place, size(level))];
    }

  private:
    static size_t index(const CubeTexel& place, uint32_t size) {
        return (size_t{place.face} * size + place.y) * size + place.x;
    }

    static float radius(const CubeTexel& place, uint32_t size, const glm::vec3& center) {
        float least = 1.0f;
        for (const glm::vec2 corner :
             {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
            const glm::vec2 uv = (glm::vec2(place.x, place.y) + corner) / static_cast<float>(size);
            least = std::min(least, glm::dot(center, cube_direction(CubePlace{place.face, uv})));
        }
        return std::acos(std::clamp(least, -1.0f, 1.0f));
    }

    static std::vector<Node> leaves(const CubeImage& cube) {
        std::vector<Node> nodes(cube.texels.size());
        for (size_t i = 0; i < nodes.size(); ++i) {
            const CubeTexel texel = cube.texel(i);
            const auto solid_angle =
                static_cast<float>(cube_solid_angle(texel.x, texel.y, cube.size));
            const glm::vec3 center = cube_direction(texel, cube.size);
            nodes[i] = {center, solid_angle, cube.texels[i] * solid_angle,
                        radius(texel, cube.size, center), center};
        }
        return nodes;
    }

    static std::vector<Node> parents(const std::vector<Node>& children, uint32_t size) {
        std::vector<Node> nodes(cube_texel_count(size));
        for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
            for (uint32_t y = 0; y < size; ++y) {
                for (uint32_t x = 0; x < size; ++x) {
                    const CubeTexel place{face, x, y};
                    nodes[index(place, size)] = parent(children, place, size);
                }
            }
        }
        return nodes;
    }

    static Node parent(const std::vector<Node>& children, const CubeTexel& place, uint32_t size) {
        Node node;
        glm::vec3 sum(0.0f), light_sum(0.0f);
        for (uint32_t i = 0; i < 4; ++i) {
            const Node& child =
                children[index({place.face, 2 * place.x + i % 2, 2 * place.y + i / 2}, 2 * size)];
            node.solid_angle += child.solid_angle;
            node.light += child.light;
            sum += child.solid_angle * child.direction;
            light_sum += (child.light.r + child.light.g + child.light.b) * child.light_direction;
        }
        node.direction = glm::normalize(sum);
        const bool is_dark = !(glm::dot(light_sum, light_sum) > 0.0f);
        node.light_direction = is_dark ? node.direction : glm::normalize(light_sum);
        node.radius = radius(place, size, node.direction);
        return node;
    }

    std::vector<std::vector<Node>> levels_;
};

/// The mean of the light of a tree by the lobe of one roughness.
class Blur {
  public:
    Blur(const CubeTree& tree, float roughness)
        : tree_(tree), alpha_squared_(roughness * roughness * roughness * roughness) {}

    [[nodiscard]] glm::vec3 at(glm::vec3 direction) const {
        Sum sum;
        for (uint32_t face = 0; face < kCubeFaceCount; ++face)
            add(tree_.level_count() - 1, {face, 0, 0}, direction, sum);
        return glm::vec3(sum.light / sum.weight);
    }

  private:
    struct Sum {
        glm::dvec3 light{0.0};
        double weight = 0.0;
    };

    void add(uint32_t level, const CubeTexel& place, glm::vec3 direction, Sum& sum) const {
        const Node& node = tree_.node(level, place);
        const float cosine = glm::dot(direction, node.direction);
        if (level > 0 && is_split(node, cosine)) {
            for (uint32_t i = 0; i < 4; ++i) {
                add(level - 1, {place.face, 2 * place.x + i % 2, 2 * place.y + i / 2}, direction,
                    sum);
            }
            return;
        }
        sum.light += glm::dvec3(lobe(glm::dot(direction, node.light_direction)) * node.light);
        sum.weight += static_cast<double>(lobe(cosine) * node.solid_angle);
    }

    /// With c = cos θ, the half angle has tan² = (1 - c) / (1 + c), and the lobe is
    /// cos θ / (sin²(θ/2) + α² cos²(θ/2))², but for a factor.
    [[nodiscard]] float lobe(float cosine) const {
        if (cosine <= 0.0f) return 0.0f;
        const float base = 0.5f * (1.0f - cosine + alpha_squared_ * (1.0f + cosine));
        return cosine / (base * base);
    }

    [[nodiscard]] bool is_split(const Node& node, float cosine) const {
        // The cosine of the angle to the nearest point of the node.
        const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
        const float angle = std::max(0.0f, std::atan2(sine, cosine) - node.radius);
        if (angle >= 0.5f * std::numbers::pi_v<float>) return false;
        const float half = std::tan(0.5f * angle);
        // The half angle over which the denominator doubles, as an angle of the reflection.
        const float change = 2.0f * std::sqrt(alpha_squared_ + half * half);
        return node.radius > kLargestShare * change;
    }

    const CubeTree& tree_;
    float alpha_squared_;
};

/// The mean of the texels that a texel of a smaller cube covers.
CubeImage smaller_cube(const CubeTree& tree, uint32_t size) {
    CubeImage cube{size, std::vector<glm::vec3>(cube_texel_count(size))};
    const auto level = tree.level_count() - static_cast<uint32_t>(std::bit_width(size));
    for (size_t i = 0; i < cube.texels.size(); ++i) {
        const Node& node = tree.node(level, cube.texel(i));
        cube.texels[i] = node.light / node.solid_angle;
    }
    return cube;
}

CubeImage blurred_cube(const CubeTree& tree, uint32_t size, float roughness,
                       uint32_t thread_count) {
    if (roughness <= 0.0f) return smaller_cube(tree, size);
    const Blur blur(tree, roughness);
    CubeImage cube{size, std::vector<glm::vec3>(cube_texel_count(size))};
    parallel_for(size_t{kCubeFaceCount} * size, thread_count, [&](size_t row) {
        for (size_t i = row * size; i < (row + 1) * size; ++i)
            cube.texels[i] = blur.at(cube_direction(cube.texel(i), size));
    });
    return cube;
}

}  // namespace

double ggx_lobe(double cos_theta, double roughness) noexcept {
    if (cos_theta <= 0.0) return 0.0;
    const double alpha = roughness * roughness;
    const double cos_half_squared = 0.5 * (1.0 + cos_theta);
    const double denominator = cos_half_squared * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (std::numbers::pi * denominator * denominator) * cos_theta;
}

CubeImage prefilter_cube(const CubeImage& source, uint32_t size, float roughness,
                         uint32_t thread_count) {
    TETRALIGHT_ASSERT(
        std::has_single_bit(source.size) && std::has_single_bit(size) && size <= source.size,
        "sizes of cubes are powers of two");
    return blurred_cube(CubeTree(source), size, roughness, thread_count);
}

std::vector<CubeImage> prefilter_levels(CubeImage cube, uint32_t thread_count) {
    TETRALIGHT_ASSERT(std::has_single_bit(cube.size), "sizes of cubes are powers of two");
    const CubeTree tree(cube);
    const uint32_t count = reflection_level_count(cube.size), size = cube.size;
    std::vector<CubeImage> levels;
    levels.push_back(std::move(cube));
    for (uint32_t level = 1; level < count; ++level) {
        levels.push_back(
            blurred_cube(tree, size >> level, roughness_of_level(level, count), thread_count));
    }
    return levels;
}

}  // namespace tetralight
