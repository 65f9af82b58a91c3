// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/edge_visibility.h>

#include <array>
#include <limits>

namespace tetralight {
namespace {

constexpr float kLeast = std::numeric_limits<float>::min();  // all weights may be 0

/// How far a corner is hidden: 0 up to `excess` 0, 1 from `ramp` on.
float hidden_part(float excess, float ramp) {
    const float t = std::min(excess * (1.0f / ramp), 1.0f);
    return (t * t) * (3.0f - 2.0f * t);
}

float sum_of(const glm::vec4& v) {
    return (v[0] + v[1]) + (v[2] + v[3]);
}

/// What L of a corner has beyond the largest sum of one wall: the least sum of parts, of the
/// corner's three edges, without which no two edges of different walls are left. `splits`: of its
/// edges 0 and 1, 0 and 2, 1 and 2.
float other_walls(const std::array<float, 3>& parts, const std::array<bool, 3>& splits) {
    if (!splits[0] && !splits[1] && !splits[2]) return 0.0f;
    const float a = parts[0] > 0.0f ? parts[0] : 0.0f;
    const float b = parts[1] > 0.0f ? parts[1] : 0.0f;
    const float c = parts[2] > 0.0f ? parts[2] : 0.0f;
    float least = std::min(a + b, std::min(a + c, b + c));
    if (!splits[2]) least = std::min(least, a);
    if (!splits[1]) least = std::min(least, b);
    if (!splits[0]) least = std::min(least, c);
    return least;
}

/// `ramp_of(corner, excess)`: over how much of L the corner's weight falls.
template <class RampOf>
glm::vec4 hide(const CellVisibility& cell, const glm::vec4& weights, RampOf ramp_of) {
    const float sum = sum_of(weights);
    const float unit = 1.0f / std::max(sum, kLeast);
    const uint32_t splits = split_bits(cell);
    // Weights of seen corners, and those of hidden ones / L² and / L⁸.
    glm::vec4 seen(0.0f), low(0.0f), steep(0.0f);
    for (int i = 0; i < 4; ++i) {
        std::array<float, 3> terms{}, parts{};  // b_j (r_ij − 1), b_j r_ij
        std::array<bool, 3> is_split{};
        for (int k = 0; k < 3; ++k) {
            const float weight = weights[(i + k + 1) & 3];
            terms[k] = weight * edge_excess(cell.codes[4 * k + i]);
            parts[k] = weight + terms[k];
            is_split[k] = (splits >> (4 * k + i) & 1) != 0;
        }
        const float others = other_walls(parts, is_split);
        const float excess = ((((terms[0] + terms[1]) + terms[2]) - weights[i]) - others) * unit;
        const float beyond = excess > 0.0f ? excess : 0.0f;
        const float part = hidden_part(beyond, ramp_of(i, beyond));
        const float ratio = 1.0f + beyond;
        const float square = 1.0f / (ratio * ratio);
        const float fourth = square * square;
        const float hidden = weights[i] * part;
        seen[i] = weights[i] * (1.0f - part);
        low[i] = hidden * square;
        steep[i] = hidden * (fourth * fourth);
    }
    const float share = (kHiddenShare * sum_of(low)) / std::max(sum_of(steep), kLeast);
    const glm::vec4 visible = seen + steep * share;
    return visible * (sum / std::max(sum_of(visible), kLeast));
}

}  // namespace

glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights) noexcept {
    return hide(cell, weights, [](int, float) { return kVisibilityRamp; });
}

glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights,
                          const glm::vec4& distances, float radius) noexcept {
    // The corner's line meets the wall at 1 / L of its length: `radius` behind that, L has grown by
    // radius · L / distance.
    return hide(cell, weights, [&](int i, float beyond) {
        const float distance = std::max(distances[i], kLeast);
        return std::max(kVisibilityRamp, radius * ((1.0f + beyond) / distance));
    });
}

}  // namespace tetralight
