// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/split_sum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace tetralight {
namespace {

constexpr double kSmallestAlpha = 1e-4;

/// Van der Corput's sequence: the bits of the index behind the point.
double reversed_bits(uint32_t index) noexcept {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 32; ++i) bits |= (index >> i & 1u) << (31 - i);
    return bits * 0x1p-32;
}

/// A normal of GGX's facets that are visible from `view`, in proportion to their visible area
/// (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
glm::dvec3 visible_normal(const glm::dvec3& view, double alpha, const glm::dvec2& sample) noexcept {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, 0.0, view.z));
    const glm::dvec3 side(0.0, 1.0, 0.0), up = glm::cross(stretched, side);
    const double radius = std::sqrt(sample.x), angle = 2.0 * std::numbers::pi * sample.y;
    const double a = radius * std::cos(angle);
    const double shared = 0.5 * (1.0 + stretched.z);
    const double b = (1.0 - shared) * std::sqrt(1.0 - a * a) + shared * radius * std::sin(angle);
    const double c = std::sqrt(std::max(0.0, 1.0 - a * a - b * b));
    const glm::dvec3 normal = a * side + b * up + c * stretched;
    return glm::normalize(
        glm::dvec3(alpha * normal.x, alpha * normal.y, std::max(1e-12, normal.z)));
}

/// G2 / G1 of height-correlated Smith masking (Heitz 2014, "Understanding the Masking-Shadowing
/// Function in Microfacet-Based BRDFs", equations 72 and 99).
double masking_ratio(double n_dot_v, double n_dot_l, double alpha) noexcept {
    const double square = alpha * alpha;
    const double v = std::sqrt(n_dot_v * n_dot_v * (1.0 - square) + square);
    const double l = std::sqrt(n_dot_l * n_dot_l * (1.0 - square) + square);
    return n_dot_l * (n_dot_v + v) / (n_dot_l * v + n_dot_v * l);
}

/// Along one axis of a table: the first of two texels, the second, and its weight.
struct TableStep {
    size_t first = 0, second = 0;
    float weight = 0.0f;
};

/// Not a number becomes 0.
TableStep table_step(float coordinate, size_t size) noexcept {
    const float place = coordinate * static_cast<float>(size) - 0.5f;
    const float clamped = place > 0.0f ? std::min(place, static_cast<float>(size - 1)) : 0.0f;
    TableStep step;
    step.first = static_cast<size_t>(clamped);
    step.second = std::min(step.first + 1, size - 1);
    step.weight = clamped - static_cast<float>(step.first);
    return step;
}

}  // namespace

glm::vec2 integrate_split_sum(float n_dot_v, float roughness, uint32_t sample_count) noexcept {
    const double z = std::clamp(static_cast<double>(n_dot_v), 0.0, 1.0);
    const double rough = std::clamp(static_cast<double>(roughness), 0.0, 1.0);
    const double alpha = std::max(rough * rough, kSmallestAlpha);
    const glm::dvec3 view(std::sqrt(1.0 - z * z), 0.0, z);
    glm::dvec2 sum(0.0);
    for (uint32_t i = 0; i < sample_count; ++i) {
        const glm::dvec2 sample((i + 0.5) / sample_count, reversed_bits(i));
        const glm::dvec3 half = visible_normal(view, alpha, sample);
        const double v_dot_h = std::clamp(glm::dot(view, half), 0.0, 1.0);
        const double n_dot_l = 2.0 * v_dot_h * half.z - z;
        if (n_dot_l <= 0.0) continue;
        const double seen = masking_ratio(z, n_dot_l, alpha);
        const double fresnel = std::pow(1.0 - v_dot_h, 5.0);
        sum += seen * glm::dvec2(1.0 - fresnel, fresnel);
    }
    return glm::vec2(sum / std::max(1.0, static_cast<double>(sample_count)));
}

std::vector<glm::vec2> make_split_sum_table(uint32_t size, uint32_t sample_count) {
    std::vector<glm::vec2> table;
    table.reserve(size_t{size} * size);
    const auto center = [size](uint32_t i) {
        return (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
    };
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            table.push_back(integrate_split_sum(center(x), center(y), sample_count));
        }
    }
    return table;
}

glm::vec2 sample_split_sum(const std::vector<glm::vec2>& table, float n_dot_v,
                           float roughness) noexcept {
    const auto size = static_cast<size_t>(std::sqrt(static_cast<double>(table.size())));
    if (size == 0) return glm::vec2(0.0f);
    const TableStep x = table_step(n_dot_v, size), y = table_step(roughness, size);
    const auto row = [&](size_t i) {
        return glm::mix(table[i * size + x.first], table[i * size + x.second], x.weight);
    };
    return glm::mix(row(y.first), row(y.second), y.weight);
}

glm::vec3 specular_f0(glm::vec3 base_color, float metallic) noexcept {
    constexpr float kDielectric = 0.04f;
    return glm::mix(glm::vec3(kDielectric), base_color, metallic);
}

}  // namespace tetralight
