// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/local_origin.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include <tetralight/base/box.h>

namespace tetralight::detail {
namespace {

/// Number of positions, evenly spaced along the curve, that the bulk is estimated from.
constexpr size_t kSampleCount = 4096;

/// The middle half of the coordinates along each axis.
Box<glm::dvec3> bulk_of(std::span<const glm::dvec3> positions) {
    const size_t stride = (positions.size() + kSampleCount - 1) / kSampleCount;
    Box<glm::dvec3> box;
    std::vector<double> coordinates;
    for (int axis = 0; axis < 3; ++axis) {
        coordinates.clear();
        for (size_t i = 0; i < positions.size(); i += stride) {
            coordinates.push_back(positions[i][axis]);
        }
        std::ranges::sort(coordinates);
        const size_t quarter = coordinates.size() / 4;
        box.min[axis] = coordinates[quarter];
        box.max[axis] = coordinates[coordinates.size() - 1 - quarter];
    }
    return box;
}

}  // namespace

glm::dvec3 local_origin(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return glm::dvec3(0.0);
    constexpr double kNear = 32.0;
    const Box<glm::dvec3> bulk = bulk_of(positions);
    const glm::dvec3 center = bulk.center();
    const bool is_near = glm::length(center) <= kNear * glm::length(bulk.size());
    return is_near ? glm::dvec3(0.0) : glm::dvec3(glm::vec3(center));
}

}  // namespace tetralight::detail
