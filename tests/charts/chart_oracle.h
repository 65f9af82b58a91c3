// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "tests/charts/chart_meshes.h"

namespace tetralight {

using UvTriangle = std::array<glm::dvec2, 3>;

[[nodiscard]] inline double cross_product(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

[[nodiscard]] inline double signed_area(const UvTriangle& t) {
    return 0.5 * cross_product(t[1] - t[0], t[2] - t[0]);
}

[[nodiscard]] inline UvTriangle uv_triangle_of(std::span<const glm::vec2> uvs, size_t triangle) {
    return {uvs[3 * triangle], uvs[3 * triangle + 1], uvs[3 * triangle + 2]};
}

/// The part of a polygon to the left of the line from a to b (Sutherland & Hodgman 1974).
[[nodiscard]] inline std::vector<glm::dvec2> clip_polygon(const std::vector<glm::dvec2>& polygon,
                                                          glm::dvec2 a, glm::dvec2 b) {
    std::vector<glm::dvec2> clipped;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double at_p = cross_product(b - a, p - a), at_q = cross_product(b - a, q - a);
        if (at_p >= 0.0) clipped.push_back(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) {
            clipped.push_back(p + (q - p) * (at_p / (at_p - at_q)));
        }
    }
    return clipped;
}

/// Area that two triangles have in common.
[[nodiscard]] inline double common_area(UvTriangle a, UvTriangle b) {
    if (signed_area(a) < 0.0) std::swap(a[1], a[2]);
    if (signed_area(b) < 0.0) std::swap(b[1], b[2]);
    std::vector<glm::dvec2> polygon(a.begin(), a.end());
    for (size_t k = 0; k < 3; ++k) polygon = clip_polygon(polygon, b[k], b[(k + 1) % 3]);
    double area = 0.0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        area += signed_area({polygon[0], polygon[i], polygon[i + 1]});
    }
    return std::abs(area);
}

/// Area in which triangles of one chart overlap, summed over pairs.
[[nodiscard]] inline double overlap_within_charts(const Unwrap& charts) {
    double overlap = 0.0;
    for (size_t i = 0; i < charts.triangle_charts.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            if (charts.triangle_charts[i] != charts.triangle_charts[j]) continue;
            overlap += common_area(uv_triangle_of(charts.corner_uvs, i),
                                   uv_triangle_of(charts.corner_uvs, j));
        }
    }
    return overlap;
}

/// Sum of the areas of all triangles in their charts.
[[nodiscard]] inline double chart_area(const Unwrap& charts) {
    double area = 0.0;
    for (size_t t = 0; t < charts.triangle_charts.size(); ++t) {
        area += std::abs(signed_area(uv_triangle_of(charts.corner_uvs, t)));
    }
    return area;
}

/// Checks that each triangle is in one of the charts, that charts start at 0 and have their size,
/// and that none is empty.
inline void expect_consistent(const OwnedMesh& mesh, const Unwrap& charts) {
    ASSERT_EQ(charts.corner_uvs.size(), mesh.indices.size());
    ASSERT_EQ(charts.triangle_charts.size(), mesh.triangle_count());
    std::vector<glm::vec2> least(charts.chart_sizes.size(), glm::vec2(INFINITY));
    std::vector<glm::vec2> most(charts.chart_sizes.size(), glm::vec2(-INFINITY));
    for (size_t corner = 0; corner < charts.corner_uvs.size(); ++corner) {
        const uint32_t chart = charts.triangle_charts[corner / 3];
        ASSERT_LT(chart, charts.chart_sizes.size());
        least[chart] = glm::min(least[chart], charts.corner_uvs[corner]);
        most[chart] = glm::max(most[chart], charts.corner_uvs[corner]);
    }
    for (size_t chart = 0; chart < charts.chart_sizes.size(); ++chart) {
        EXPECT_EQ(least[chart], glm::vec2(0.0f)) << chart;
        EXPECT_EQ(most[chart], charts.chart_sizes[chart]) << chart;
    }
}

/// Checks that each triangle keeps at least the cosine of the largest angle of its area, is not
/// mirrored, and has no edge that got longer.
inline void expect_little_stretch(const OwnedMesh& mesh, const Unwrap& charts,
                                  double max_angle_degrees) {
    constexpr double kRounding = 1e-5;
    const double min_cosine = std::cos(max_angle_degrees * std::numbers::pi / 180.0);
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const UvTriangle uv = uv_triangle_of(charts.corner_uvs, t);
        const double slack =
            kRounding * (mesh.area(t) + 1e-3 * glm::dot(uv[1] - uv[0], uv[1] - uv[0]));
        EXPECT_GE(signed_area(uv), min_cosine * mesh.area(t) - slack) << "triangle " << t;
        EXPECT_LE(signed_area(uv), mesh.area(t) + slack) << "triangle " << t;
        for (size_t k = 0; k < 3; ++k) {
            const double length = glm::distance(mesh.corner(t, k), mesh.corner(t, (k + 1) % 3));
            EXPECT_LE(glm::distance(uv[k], uv[(k + 1) % 3]), length * (1.0 + kRounding) + 1e-6);
        }
    }
}

/// All of the above, and that no triangles of a chart overlap.
inline void expect_good_charts(const OwnedMesh& mesh, const Unwrap& charts,
                               double max_angle_degrees = UnwrapSettings{}.max_angle_degrees) {
    expect_consistent(mesh, charts);
    expect_little_stretch(mesh, charts, max_angle_degrees);
    EXPECT_LE(overlap_within_charts(charts), 1e-5 * chart_area(charts));
}

}  // namespace tetralight
