// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/group_spacing.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/probes/build/detail/position_tree.h>

namespace tetralight {
namespace {

using detail::PositionTree;

double distance_to_box(const PositionTree::Node& node, const glm::dvec3& p) {
    return glm::distance(p, glm::clamp(p, node.bounds.min, node.bounds.max));
}

/// Lowers `nearest` to the distance of the nearest position of a node that is not `from` itself.
void search(std::span<const PositionTree::Node> nodes, std::span<const glm::dvec3> positions,
            uint32_t number, const glm::dvec3& from, double& nearest) {
    const PositionTree::Node& node = nodes[number];
    if (distance_to_box(node, from) >= nearest) return;
    if (!node.is_leaf()) {
        search(nodes, positions, number + 1, from, nearest);
        search(nodes, positions, node.second_child, from, nearest);
        return;
    }
    for (uint32_t i = node.begin; i < node.end; ++i) {
        if (positions[i] != from) nearest = std::min(nearest, glm::distance(from, positions[i]));
    }
}

/// The probes of each group, ascending: that is along the Hilbert curve.
std::vector<std::vector<uint32_t>> probes_by_group(const MergedProbes& merged) {
    std::vector<std::vector<uint32_t>> groups(merged.group_names.size());
    for (const ProbeSource& source : merged.sources) {
        if (source.probe != kNoIndex) groups[source.group].push_back(source.probe);
    }
    for (auto& probes : groups) {
        std::ranges::sort(probes);
        probes.erase(std::unique(probes.begin(), probes.end()), probes.end());
    }
    return groups;
}

}  // namespace

std::vector<double> group_spacing(const MergedProbes& merged, std::span<const uint32_t> probes) {
    std::vector<double> spacing(merged.positions.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> is_asked_for(merged.positions.size(), false);
    for (const uint32_t probe : probes) is_asked_for[probe] = true;
    const auto is_asked = [&](uint32_t probe) { return is_asked_for[probe]; };
    for (const std::vector<uint32_t>& group : probes_by_group(merged)) {
        if (std::ranges::none_of(group, is_asked)) continue;
        std::vector<glm::dvec3> positions;
        for (const uint32_t probe : group) positions.push_back(merged.positions[probe]);
        const PositionTree tree(positions);
        for (const uint32_t probe : group) {
            if (!is_asked(probe)) continue;
            search(tree.nodes(), positions, 0, merged.positions[probe], spacing[probe]);
        }
    }
    std::vector<double> result;
    for (const uint32_t probe : probes) result.push_back(spacing[probe]);
    return result;
}

}  // namespace tetralight
