// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/unwrap.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <tetralight/base/contract.h>
#include <tetralight/charts/detail/flat_triangle.h>
#include <tetralight/charts/detail/grow_charts.h>
#include <tetralight/charts/detail/merge_charts.h>
#include <tetralight/charts/detail/smallest_rectangle.h>

namespace tetralight {

namespace {

using detail::MeshTopology;
using detail::PlaneFrame;
using detail::SurfaceChart;

/// The frame of a chart, turned so that its first axis is a side of the smallest rectangle.
PlaneFrame fitted_frame(const MeshTopology& mesh, const SurfaceChart& chart) {
    const PlaneFrame frame = detail::make_plane_frame(chart.axis);
    std::vector<glm::dvec2> points;
    for (const uint32_t triangle : chart.triangles) {
        for (const uint32_t point : mesh.triangles[triangle]) {
            points.push_back(frame.project(mesh.points[point]));
        }
    }
    const glm::dvec2 side = detail::smallest_rectangle_side(std::move(points));
    return {side.x * frame.u + side.y * frame.v, side.x * frame.v - side.y * frame.u};
}

/// Writes the UVs of one chart and returns its size.
glm::vec2 write_uvs(const MeshTopology& mesh, const SurfaceChart& chart,
                    std::vector<glm::vec2>& uvs) {
    const PlaneFrame frame = fitted_frame(mesh, chart);
    const auto at = [&](uint32_t triangle, uint32_t k) {
        return frame.project(mesh.points[mesh.triangles[triangle][k]]);
    };
    glm::dvec2 least = at(chart.triangles[0], 0);
    for (const uint32_t triangle : chart.triangles) {
        for (uint32_t k = 0; k < 3; ++k) least = glm::min(least, at(triangle, k));
    }
    glm::vec2 size(0.0f);
    for (const uint32_t triangle : chart.triangles) {
        for (uint32_t k = 0; k < 3; ++k) {
            glm::vec2& uv = uvs[3 * triangle + k];
            uv = glm::vec2(at(triangle, k) - least);
            size = glm::max(size, uv);
        }
    }
    return size;
}

}  // namespace

Unwrap unwrap(const ChartMesh& mesh, const UnwrapSettings& settings) {
    TETRALIGHT_ASSERT(settings.max_angle_degrees > 0.0f && settings.max_angle_degrees <= 89.0f,
                      "the largest angle is in (0, 89]");
    const double min_cosine = std::cos(glm::radians(double{settings.max_angle_degrees}));
    const MeshTopology topology = detail::make_mesh_topology(mesh);
    const std::vector<SurfaceChart> charts =
        detail::merge_charts(topology, detail::grow_charts(topology, min_cosine), min_cosine);
    Unwrap result;
    result.corner_uvs.resize(mesh.indices.size());
    result.triangle_charts.resize(topology.triangles.size());
    for (uint32_t c = 0; c < charts.size(); ++c) {
        for (const uint32_t triangle : charts[c].triangles) result.triangle_charts[triangle] = c;
        result.chart_sizes.push_back(write_uvs(topology, charts[c], result.corner_uvs));
    }
    return result;
}

}  // namespace tetralight
