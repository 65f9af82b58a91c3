// SPDX-License-Identifier: Apache-2.0
#include "pipeline/dilate_probes.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>

#include "base/assert.h"

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

/// The mean light of the lit ends of a probe's edges; none when there is no such end.
std::optional<IrradianceSh> light_around(std::span<const Edge> edges, const ProbeVolume& volume,
                                         const std::vector<bool>& is_lit) {
    IrradianceSh sum;
    float weights = 0.0f;
    for (const auto& [from, to] : edges) {
        if (!is_lit[to]) continue;
        const float distance = glm::distance(volume.positions[from], volume.positions[to]);
        const float weight = 1.0f / std::max(distance * distance, 1e-30f);
        sum += weight * volume.irradiance[to];
        weights += weight;
    }
    if (weights == 0.0f) return std::nullopt;
    return sum * (1.0f / weights);
}

/// Lights all probes that are next to lit ones, from what was lit before, and returns how many.
size_t spread(std::span<const Edge> edges, std::vector<bool>& is_lit, ProbeVolume& volume) {
    std::vector<std::pair<uint32_t, IrradianceSh>> found;
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        const uint32_t probe = edges[begin].first;
        while (end < edges.size() && edges[end].first == probe) ++end;
        if (is_lit[probe]) continue;
        const auto light = light_around(edges.subspan(begin, end - begin), volume, is_lit);
        if (light) found.emplace_back(probe, *light);
    }
    for (const auto& [probe, light] : found) {
        volume.irradiance[probe] = light;
        volume.health[probe].is_dilated = 1;
        is_lit[probe] = true;
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
    while (const size_t more = spread(edges, is_lit, volume)) count += more;
    return count;
}

}  // namespace tetralight
