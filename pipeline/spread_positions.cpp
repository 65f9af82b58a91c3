// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/spread_positions.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

size_t nearest_to_mean(std::span<const glm::dvec3> positions) {
    glm::dvec3 mean(0.0);
    for (const glm::dvec3& position : positions) mean += position;
    mean /= static_cast<double>(positions.size());
    const auto nearest = std::ranges::min_element(
        positions, {}, [&](const glm::dvec3& position) { return glm::distance(position, mean); });
    return static_cast<size_t>(nearest - positions.begin());
}

}  // namespace

std::vector<size_t> spread_positions(std::span<const glm::dvec3> positions, double spacing,
                                     size_t most) {
    std::vector<size_t> chosen;
    if (positions.empty() || most == 0) return chosen;
    std::vector<double> distances(positions.size(), std::numeric_limits<double>::infinity());
    size_t next = nearest_to_mean(positions);
    do {
        chosen.push_back(next);
        for (size_t i = 0; i < positions.size(); ++i) {
            distances[i] = std::min(distances[i], glm::distance(positions[i], positions[next]));
        }
        next = static_cast<size_t>(std::ranges::max_element(distances) - distances.begin());
    } while (chosen.size() < most && distances[next] > spacing);
    return chosen;
}

glm::dvec3 rounded_to_millimetre(const glm::dvec3& position) {
    return glm::round(position * 1000.0) / 1000.0 + 0.0;  // no -0
}

}  // namespace tetralight
