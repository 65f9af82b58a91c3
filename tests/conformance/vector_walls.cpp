// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/vector_walls.h"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight::conformance {
namespace {

/// What the walls do to an edge.
struct EdgeRatio {
    double ratio = -std::numeric_limits<double>::infinity();
    size_t wall = 0;  ///< the one that gives the ratio
};

/// The distance from a wall is linear, so that it blocks the edge at the fraction
/// d_from / (d_from − d_to): the ratio is the inverse, and below 1 where both are on one side.
EdgeRatio edge_ratio(std::span<const WallPlane> walls, const glm::dvec3& from,
                     const glm::dvec3& to) {
    EdgeRatio edge;
    for (size_t i = 0; i < walls.size(); ++i) {
        const double d_from = glm::dot(walls[i].normal, from) - walls[i].offset;
        const double d_to = glm::dot(walls[i].normal, to) - walls[i].offset;
        const double ratio = 1.0 - d_to / d_from;
        if (ratio > edge.ratio) edge = {ratio, i};
    }
    return edge;
}

}  // namespace

void add_walls(ProbeVolume& volume, std::span<const WallPlane> walls) {
    const ProbeEdges edges(volume.view());
    const auto position = [&](uint32_t probe) { return glm::dvec3(volume.positions[probe]); };
    std::vector<uint8_t> codes;
    for (uint32_t from = 0; from < volume.positions.size(); ++from) {
        for (const uint32_t to : edges.targets(from)) {
            codes.push_back(
                encode_edge_ratio(edge_ratio(walls, position(from), position(to)).ratio));
        }
    }
    store_visibility(edges, codes, volume);
    set_all_splits(volume, [&](uint32_t from, uint32_t a, uint32_t b) {
        return edge_ratio(walls, position(from), position(a)).wall !=
               edge_ratio(walls, position(from), position(b)).wall;
    });
}

void add_random_walls(ProbeVolume& volume, Numbers& numbers) {
    const ProbeEdges edges(volume.view());
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) {
        const size_t highest = numbers.below(2) == 0 ? size_t{kUnknownEdge} : size_t{160};
        code = static_cast<uint8_t>(numbers.below(highest));
    }
    store_visibility(edges, codes, volume);
    const uint64_t seed = numbers.below(1u << 20);
    set_all_splits(volume, [&](uint32_t from, uint32_t a, uint32_t b) {
        return Numbers(seed + from + 64u * (a + 64u * b)).below(2) == 0;
    });
}

}  // namespace tetralight::conformance
