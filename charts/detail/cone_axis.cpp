// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/cone_axis.h>

#include <glm/geometric.hpp>

namespace tetralight::detail {

namespace {

struct Farthest {
    double cosine = 2.0;
    glm::dvec3 normal{};
};

Farthest farthest_from(std::span<const glm::dvec3> normals, glm::dvec3 axis) {
    Farthest farthest;
    for (const glm::dvec3& normal : normals) {
        const double cosine = glm::dot(normal, axis);
        if (cosine < farthest.cosine && normal != glm::dvec3(0.0)) farthest = {cosine, normal};
    }
    return farthest;
}

}  // namespace

std::optional<glm::dvec3> find_cone_axis(std::span<const glm::dvec3> normals, glm::dvec3 start,
                                         double min_cosine) {
    constexpr int kSteps = 16;
    // Normals of which two are farther apart than the cone is wide have no axis.
    const double widest_cosine = 2.0 * min_cosine * min_cosine - 1.0;
    glm::dvec3 axis = start;
    glm::dvec3 previous{};
    for (int step = 0; step < kSteps; ++step) {
        const Farthest farthest = farthest_from(normals, axis);
        if (farthest.cosine >= min_cosine) return axis;
        if (step > 0 && glm::dot(farthest.normal, previous) < widest_cosine) return std::nullopt;
        previous = farthest.normal;
        const glm::dvec3 turned = axis + (farthest.normal - axis) / (step + 2.0);
        if (!(glm::dot(turned, turned) > 0.0)) return std::nullopt;
        axis = glm::normalize(turned);
    }
    return std::nullopt;
}

}  // namespace tetralight::detail
