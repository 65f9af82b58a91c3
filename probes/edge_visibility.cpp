// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/edge_visibility.h>

#include <array>
#include <limits>

namespace tetralight {

float visible_share(float excess) noexcept {
    const float beyond = excess > 0.0f ? excess : 0.0f;
    const float t = std::min(beyond * (1.0f / kVisibilityRamp), 1.0f);
    const float step = (t * t) * (3.0f - 2.0f * t);
    const float ratio = 1.0f + beyond;
    return (1.0f - step) + step * (kHiddenShare / (ratio * ratio));
}

glm::vec4 visible_weights(const CellVisibility& cell, const glm::vec4& weights) noexcept {
    constexpr float kLeast = std::numeric_limits<float>::min();  // all weights may be 0
    const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
    const float unit = 1.0f / std::max(sum, kLeast);
    glm::vec4 visible(0.0f);
    for (int i = 0; i < 4; ++i) {
        std::array<float, 3> terms{};  // b_j (r_ij − 1)
        for (int k = 0; k < 3; ++k) {
            terms[k] = weights[(i + k + 1) & 3] * edge_excess(cell.codes[4 * k + i]);
        }
        const float excess = (((terms[0] + terms[1]) + terms[2]) - weights[i]) * unit;
        visible[i] = weights[i] * visible_share(excess);
    }
    const float seen = (visible[0] + visible[1]) + (visible[2] + visible[3]);
    return visible * (sum / std::max(seen, kLeast));
}

CellLocation visible_location(const ProbeVolumeView& volume, CellLocation location) noexcept {
    const uint32_t element = find_visibility(volume, location.cell);
    if (element == kNoIndex) return location;
    location.weights = visible_weights(volume.cell_visibility[element], location.weights);
    return location;
}

void hide_probes(const ProbeVolumeView& volume, std::span<CellLocation> locations,
                 Walls walls) noexcept {
    if (walls == Walls::Ignore || volume.visibility_blocks.empty()) return;
    for (CellLocation& location : locations) location = visible_location(volume, location);
}

}  // namespace tetralight
