// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/mesh_shape.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace tetralight {
namespace {

constexpr double kStep = 0x1p-16;

/// A matrix R with Rᵀ R = metric (Cholesky); directions that the transform flattens give zeros.
glm::dmat3 root_of(const MeshShape& shape) {
    const auto& m = shape.metric;
    const auto at = [&](size_t i) { return kStep * static_cast<double>(m[i]); };
    const double xx = at(0), xy = at(1), xz = at(2), yy = at(3), yz = at(4), zz = at(5);
    const auto ratio = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
    const double a = std::sqrt(std::max(0.0, xx));
    const double b = ratio(xy, a), c = ratio(xz, a);
    const double d = std::sqrt(std::max(0.0, yy - b * b));
    const double e = ratio(yz - b * c, d);
    const double f = std::sqrt(std::max(0.0, zz - c * c - e * e));
    return {{a, 0.0, 0.0}, {b, d, 0.0}, {c, e, f}};
}

}  // namespace

ShapedTransform shape_of(const MeshInstance& instance) {
    const glm::dmat3 linear(instance.world_from_mesh);
    const glm::dmat3 metric = glm::transpose(linear) * linear;
    ShapedTransform result;
    const double square = (metric[0][0] + metric[1][1] + metric[2][2]) / 3.0;
    if (!(square > 0.0)) return result;
    result.size = std::sqrt(square);
    const auto step = [&](int column, int row) {
        return std::llround(metric[column][row] / square / kStep);
    };
    result.shape.metric = {step(0, 0), step(1, 0), step(2, 0), step(1, 1), step(2, 1), step(2, 2)};
    return result;
}

std::vector<glm::vec3> shaped_positions(std::span<const glm::vec3> positions,
                                        const MeshShape& shape) {
    const glm::dmat3 root = root_of(shape);
    std::vector<glm::vec3> shaped(positions.size());
    std::ranges::transform(positions, shaped.begin(), [&](const glm::vec3& position) {
        return glm::vec3(root * glm::dvec3(position));
    });
    return shaped;
}

}  // namespace tetralight
