// SPDX-License-Identifier: Apache-2.0
#include "probes/build/quality.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace tetralight
