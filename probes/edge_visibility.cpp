// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/edge_visibility.h>

#include <array>
#include <limits>

namespace tetralight {
namespace {

constexpr float kLeast = std::numeric_limits<float>::min();  // all weights may be 0

/// Multiplies each weight by `share_of(corner, excess)`, then all so that they keep their sum.
template <class ShareOf>
glm::vec4 hide(const CellVisibility& cell, const glm::vec4& weights, ShareOf share_of) {
    const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
    const float unit = 1.0f / std::max(sum, kLeast);
    glm::vec4 visible(0.0f);
    for (int i = 0; i < 4; ++i) {
        std::array<float, 3> terms{};  // b_j (r_ij − 1)
        for (int k = 0; k < 3; ++k) {
            terms[k] = weights[(i + k + 1) & 3] * edge_excess(cell.codes[4 * k + i]);
        }
        const float excess = (((terms[0] + terms[1]) + terms[2]) - weights[i]) * unit;
        visible[i] = weights[i] * share_of(i, excess);
    }
    const float seen = (visible[0] + visible[1]) + (visible[2] + visible[3]);
    return visible * (sum / std::max(seen, kLeast));
}

}  // namespace

float visible_share(float excess, float ramp) noexcept {
    const float beyond = excess > 0.0f ? excess : 0.0f;
    const float t = std::min(beyond * (1.0f / ramp), 1.0f);
    const float step = (t * t) * (3.0f - 2.0f * t);
    const float ratio = 1.0f + beyond;
    return (1.0f - step) + step * (kHiddenShare / (ratio * ratio));
}

glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights) noexcept {
    return hide(cell, weights, [](int, float excess) { return visible_share(excess); });
}

glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights,
                          const glm::vec4& distances, float radius) noexcept {
    // The corner's line meets the wall at 1 / L of its length: `radius` behind that, L has grown by
    // radius · L / distance.
    return hide(cell, weights, [&](int i, float excess) {
        const float ratio = 1.0f + std::max(excess, 0.0f);
        const float distance = std::max(distances[i], kLeast);
        return visible_share(excess, std::max(kVisibilityRamp, radius * (ratio / distance)));
    });
}

}  // namespace tetralight
