// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/hull_rays.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/probes/detail/hull_cell.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

struct Hull {
    std::vector<glm::dvec3> positions;
    Tetrahedralization cells;
    HullRays rays;

    explicit Hull(std::vector<glm::dvec3> p)
        : positions(std::move(p)),
          cells(tetrahedralize(positions)),
          rays(make_hull_rays(positions, cells)) {}

    [[nodiscard]] glm::dvec3 extruded(size_t hull_cell, int corner, double t) const {
        const uint32_t v = cells.cells[cells.inner_cell_count + hull_cell].vertices[corner];
        return positions[v] + t * glm::dvec3(rays.cells[hull_cell].rays[corner]);
    }
};

TEST(HullRays, OfARegularTetrahedronAreRadial) {
    const Hull hull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
    EXPECT_EQ(hull.rays.radial_fraction, 0.0f);
    for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = hull.cells.cells[1 + i].vertices[k];
            const glm::vec3 radial(glm::normalize(hull.positions[v]));
            EXPECT_LT(glm::distance(hull.rays.cells[i].rays[k], radial), 1e-6f);
        }
    }
}

TEST(HullRays, AreUnitVectorsThatLeaveTheHull) {
    const Hull hull(test::random_positions(200, 1));
    for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
        const glm::dvec3 a = hull.extruded(i, 0, 0), b = hull.extruded(i, 1, 0);
        const glm::dvec3 normal = glm::cross(b - a, hull.extruded(i, 2, 0) - a);
        for (const glm::vec3& ray : hull.rays.cells[i].rays) {
            EXPECT_NEAR(glm::length(ray), 1.0f, 1e-6f);
            EXPECT_GT(glm::dot(glm::dvec3(ray), normal), 0.0);
        }
    }
}

TEST(HullRays, NoExtrudedTriangleFoldsOver) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
        const Hull hull(test::random_positions(8 + seed, seed));
        for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
            for (double t = 0.0; t < 1e4; t = t * 1.5 + 0.01) {
                const glm::dvec3 a = hull.extruded(i, 0, t), b = hull.extruded(i, 1, t);
                const glm::dvec3 c = hull.extruded(i, 2, t);
                const glm::dvec3 normal = glm::cross(b - a, c - a);
                for (const glm::vec3& ray : hull.rays.cells[i].rays) {
                    ASSERT_GT(glm::dot(glm::dvec3(ray), normal), 0.0)
                        << seed << " " << i << " " << t;
                }
            }
        }
    }
}

TEST(HullRays, TakeNoMoreOfTheRadialDirectionThanNeeded) {
    // A box's angle-weighted vertex normals are its diagonals: nothing folds.
    std::vector<glm::dvec3> box;
    for (int i = 0; i < 8; ++i) box.emplace_back(i & 1 ? 3 : 0, i & 2 ? 1 : 0, i & 4 ? 2 : 0);
    EXPECT_EQ(Hull(box).rays.radial_fraction, 0.0f);
}

TEST(HullRays, OfCloseVerticesDifferWhenAnotherVertexIsFarAway) {
    auto positions = test::random_positions(200, 7);
    positions.emplace_back(1e9, 3e8, -2e8);
    const Hull hull(positions);
    for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
        const auto& rays = hull.rays.cells[i].rays;
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_GT(glm::distance(rays[k], rays[(k + 1) % 3]), 1e-3f) << i;
        }
    }
}

TEST(HullCell, FindsTheWeightsOfPositionsThatItWasExtrudedThrough) {
    const Hull hull(test::random_positions(60, 3));
    std::mt19937_64 engine(4);
    std::exponential_distribution<double> share;
    for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
        for (const double t : {0.0, 1e-6, 0.1, 3.0, 100.0, 1e4}) {
            glm::dvec3 w(share(engine), share(engine), share(engine));
            w /= w.x + w.y + w.z;
            glm::dvec3 position(0.0);
            for (int k = 0; k < 3; ++k) position += w[k] * hull.extruded(i, k, t);
            std::array<glm::dvec3, 3> corners;
            for (int k = 0; k < 3; ++k) corners[k] = hull.extruded(i, k, 0.0);
            // At t = 0 rounding may put the position just behind the triangle.
            if (t == 0.0) position += 1e-12 * glm::dvec3(hull.rays.cells[i].rays[0]);
            const auto weights = detail::hull_cell_weights(
                detail::make_hull_triangle(corners, position), hull.rays.cells[i]);
            ASSERT_TRUE(weights) << i << " " << t;
            EXPECT_LT(glm::distance(*weights, w), 1e-6) << i << " " << t;
        }
    }
}

TEST(HullCell, SaysWhenAPositionIsBehindTheTriangle) {
    const Hull hull(test::random_positions(60, 5));
    for (size_t i = 0; i < hull.rays.cells.size(); ++i) {
        std::array<glm::dvec3, 3> corners;
        for (int k = 0; k < 3; ++k) corners[k] = hull.extruded(i, k, 0.0);  // the origin is inside
        const auto triangle = detail::make_hull_triangle(corners, glm::dvec3(0.0));
        EXPECT_FALSE(detail::hull_cell_weights(triangle, hull.rays.cells[i]));
    }
}

}  // namespace
}  // namespace tetralight
