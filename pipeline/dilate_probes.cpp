// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/dilate_probes.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

/// (probe, neighbor) for each invalid probe and all its neighbors in the cells, sorted.
std::vector<Edge> edges_of(const std::vector<bool>& probes, const ProbeVolume& volume) {
    std::vector<Edge> edges;
    for (const Cell& cell : std::span(volume.cells).first(volume.info.inner_cell_count)) {
        for (const uint32_t from : cell.vertices) {
            if (from == kNoIndex || !probes[from]) continue;
            for (const uint32_t to : cell.vertices) {
                if (to != kNoIndex && to != from) edges.emplace_back(from, to);
            }
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::ranges::unique(edges).begin(), edges.end());
    return edges;
}

/// A probe and its lit neighbors with their weights; `total` is the sum of the weights.
struct Blend {
    uint32_t probe = 0;
    std::vector<std::pair<uint32_t, float>> parts;
    float total = 0.0f;
};

/// Nothing if the probe has no lit neighbor.
std::optional<Blend> blend_around(std::span<const Edge> edges, const ProbeVolume& volume,
                                  const std::vector<bool>& is_lit) {
    Blend blend{edges[0].first, {}, 0.0f};
    for (const auto& [from, to] : edges) {
        if (!is_lit[to]) continue;
        const float distance = glm::distance(volume.positions[from], volume.positions[to]);
        const float weight = 1.0f / std::max(distance * distance, 1e-30f);
        blend.parts.emplace_back(to, weight);
        blend.total += weight;
    }
    if (blend.parts.empty()) return std::nullopt;
    return blend;
}

void apply(const Blend& blend, std::span<IrradianceSh> light) {
    IrradianceSh sum;
    for (const auto& [probe, weight] : blend.parts) sum += weight * light[probe];
    light[blend.probe] = sum * (1.0f / blend.total);
}

void apply(const Blend& blend, std::vector<ProbeTransfer>& transfer) {
    ProbeTransfer sum;
    for (const auto& [probe, part] : blend.parts) {
        const float weight = part / blend.total;
        for (int i = 0; i < kShCoefficientCount; ++i) {
            for (int j = 0; j < kDistantCoefficientCount; ++j) {
                sum.direct[i][j] += weight * transfer[probe].direct[i][j];
                sum.bounced[i][j] += weight * transfer[probe].bounced[i][j];
            }
        }
    }
    transfer[blend.probe] = sum;
}

/// Only neighbors that store the same light in a channel count there.
void apply_to_occlusion(const Blend& blend, ProbeVolume& volume) {
    const OcclusionLights& own = volume.occlusion_lights[blend.probe];
    for (int channel = 0; channel < 4; ++channel) {
        const auto index = static_cast<size_t>(channel);
        float sum = 0.0f, total = 0.0f;
        for (const auto& [probe, weight] : blend.parts) {
            if (volume.occlusion_lights[probe][index] != own[index]) continue;
            sum += weight * volume.occlusion[probe][channel];
            total += weight;
        }
        if (total > 0.0f) {
            volume.occlusion[blend.probe][channel] = std::clamp(sum / total, 0.0f, 1.0f);
        }
    }
}

void apply(const Blend& blend, ProbeVolume& volume) {
    const size_t count = volume.positions.size();
    apply(blend, std::span(volume.irradiance));
    for (size_t first = 0; first < volume.layer_irradiance.size(); first += count) {
        apply(blend, std::span(volume.layer_irradiance).subspan(first, count));
    }
    if (!volume.transfer.empty()) apply(blend, volume.transfer);
    if (!volume.occlusion.empty()) apply_to_occlusion(blend, volume);
    volume.health[blend.probe].is_dilated = 1;
}

/// Dilates all unlit probes with a neighbor that was lit before this call. Returns their number.
size_t dilate_once(std::span<const Edge> edges, std::vector<bool>& is_lit, ProbeVolume& volume) {
    std::vector<Blend> found;
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        const uint32_t probe = edges[begin].first;
        while (end < edges.size() && edges[end].first == probe) ++end;
        if (is_lit[probe]) continue;
        auto blend = blend_around(edges.subspan(begin, end - begin), volume, is_lit);
        if (blend) found.push_back(std::move(*blend));
    }
    for (const Blend& blend : found) {
        apply(blend, volume);  // from probes that were lit before: none of `found`
        is_lit[blend.probe] = true;
    }
    return found.size();
}

}  // namespace

size_t dilate_probes(const std::vector<bool>& is_invalid, ProbeVolume& volume) {
    TETRALIGHT_ASSERT(volume.irradiance.size() == is_invalid.size(), "one irradiance a probe");
    TETRALIGHT_ASSERT(volume.health.size() == is_invalid.size(), "one health record a probe");
    const std::vector<Edge> edges = edges_of(is_invalid, volume);
    std::vector<bool> is_lit(is_invalid);
    is_lit.flip();
    size_t count = 0;
    while (const size_t more = dilate_once(edges, is_lit, volume)) count += more;
    return count;
}

}  // namespace tetralight
