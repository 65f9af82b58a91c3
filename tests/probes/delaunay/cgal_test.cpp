// SPDX-License-Identifier: Apache-2.0
// The same sets by CGAL (GPL-3.0-or-later), which perturbs positions on one sphere in the same way.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <tetralight/probes/delaunay/delaunay_triangles.h>
#include "tests/probes/delaunay/delaunay_checks.h"
#include "tests/probes/delaunay/point_families.h"

namespace tetralight::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = std::array<std::array<double, 2>, 3>;

std::set<Corners> tetrahedra_of_cgal(const std::vector<glm::dvec3>& positions) {
    std::vector<Kernel::Point_3> points;
    for (const glm::dvec3& p : positions) points.emplace_back(p.x, p.y, p.z);
    const CGAL::Delaunay_triangulation_3<Kernel> delaunay(points.begin(), points.end());
    std::set<Corners> result;
    if (delaunay.dimension() < 3) return result;
    for (const auto cell : delaunay.finite_cell_handles()) {
        Corners corners;
        for (int i = 0; i < 4; ++i) {
            const auto& p = cell->vertex(i)->point();
            corners[static_cast<size_t>(i)] = {p.x(), p.y(), p.z()};
        }
        std::ranges::sort(corners);
        result.insert(corners);
    }
    return result;
}

std::set<Triangle> triangles_of_cgal(const std::vector<glm::dvec2>& positions) {
    std::vector<Kernel::Point_2> points;
    for (const glm::dvec2& p : positions) points.emplace_back(p.x, p.y);
    const CGAL::Delaunay_triangulation_2<Kernel> delaunay(points.begin(), points.end());
    std::set<Triangle> result;
    if (delaunay.dimension() < 2) return result;
    for (const auto face : delaunay.finite_face_handles()) {
        Triangle corners;
        for (int i = 0; i < 3; ++i) {
            const auto& p = face->vertex(i)->point();
            corners[static_cast<size_t>(i)] = {p.x(), p.y()};
        }
        std::ranges::sort(corners);
        result.insert(corners);
    }
    return result;
}

std::set<Triangle> triangles_of(const std::vector<glm::dvec2>& positions) {
    DelaunayTriangles delaunay;
    EXPECT_TRUE(delaunay.make(positions));
    std::set<Triangle> result;
    for (const DelaunayTriangle& cell : delaunay.cells()) {
        if (cell.is_ghost()) continue;
        Triangle corners;
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec2& p = positions[cell.vertices[i]];
            corners[i] = {p.x, p.y};
        }
        std::ranges::sort(corners);
        result.insert(corners);
    }
    return result;
}

class DelaunayAndCgal : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, DelaunayAndCgal, testing::ValuesIn(kPointFamilies),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(DelaunayAndCgal, MakeTheSameTetrahedra) {
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        for (const size_t count : {5, 20, 100, 1500}) {
            const auto points = make_points(GetParam(), count, seed);
            EXPECT_EQ(tetrahedra(delaunay_of(points)), tetrahedra_of_cgal(points)) << seed;
        }
    }
}

TEST_P(DelaunayAndCgal, MakeTheSameTriangles) {
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        for (const size_t count : {3, 10, 100, 1500}) {
            std::set<std::array<double, 2>> seen;
            std::vector<glm::dvec2> points;
            for (const glm::dvec3& p : make_points(GetParam(), count, seed)) {
                if (seen.insert({p.x, p.y}).second) points.emplace_back(p.x, p.y);
            }
            EXPECT_EQ(triangles_of(points), triangles_of_cgal(points)) << seed;
        }
    }
}

}  // namespace
}  // namespace tetralight::test
