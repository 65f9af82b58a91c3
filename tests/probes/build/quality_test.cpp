// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/quality.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tetralight {
namespace {

TEST(TetrahedronQuality, IsOneForTheRegularTetrahedronOfAnySize) {
    for (const double s : {1e-6, 1.0, 1e6}) {
        EXPECT_NEAR(tetrahedron_quality({s, s, s}, {-s, -s, s}, {-s, s, -s}, {s, -s, -s}), 1.0,
                    1e-14);
    }
}

TEST(TetrahedronQuality, IsThatOfTheCornerOfACube) {
    // Volume 1/6, three edges of 1 and three of √2: 6√2/6 / 1.5^1.5.
    EXPECT_NEAR(tetrahedron_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                std::sqrt(2.0) / std::pow(1.5, 1.5), 1e-15);
}

TEST(TetrahedronQuality, IsZeroWhenFlatAndNegativeWhenTurned) {
    EXPECT_EQ(tetrahedron_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0.0);
    EXPECT_EQ(tetrahedron_quality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0.0);
    EXPECT_LT(tetrahedron_quality({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), 0.0);
}

TEST(MeasureQuality, CountsSliversAndFlatTetrahedra) {
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {1, 0, 0},    {0, 1, 0},
                                            {0, 0, 1}, {1, 1, 1e-4}, {1, 1, 1e-8}};
    const auto cell = [](uint32_t last) { return Cell{{0, 1, 2, last}, {}}; };
    const std::vector<Cell> cells{cell(3), cell(4), cell(5), cell(3)};
    const QualityReport report = measure_quality(positions, cells);
    EXPECT_EQ(report.tetrahedra, 4u);
    EXPECT_EQ(report.slivers, 2u);
    EXPECT_EQ(report.flat, 1u);
    EXPECT_EQ(report.sliver_fraction(), 0.5);
    EXPECT_EQ(report.smallest,
              tetrahedron_quality(positions[0], positions[1], positions[2], positions[5]));
    EXPECT_EQ(measure_quality({}, {}).sliver_fraction(), 0.0);
}

}  // namespace
}  // namespace tetralight
