// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/lattice.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace tetralight {
namespace {

TEST(Lattice, CountsXFastestThenZThenY) {
    const auto lattice = make_lattice({{0, 0, 0}, {2, 4, 3}}, glm::dvec3(1.0), 100);
    ASSERT_TRUE(lattice);
    ASSERT_EQ(lattice->count(), 24u);
    EXPECT_EQ(lattice->at(0), glm::dvec3(0.5, 0.5, 0.5));
    EXPECT_EQ(lattice->at(1), glm::dvec3(1.5, 0.5, 0.5));
    EXPECT_EQ(lattice->at(2), glm::dvec3(0.5, 0.5, 1.5));
    EXPECT_EQ(lattice->at(6), glm::dvec3(0.5, 1.5, 0.5));
    EXPECT_EQ(lattice->positions().back(), glm::dvec3(1.5, 3.5, 2.5));
}

RC_GTEST_PROP(Lattice, FloatsHoldItExactly, ()) {
    const auto coordinate = [] { return *rc::gen::inRange(-1000000, 1000000) / 997.0; };
    const double spacing = *rc::gen::inRange(100, 3000) / 983.0;
    WorldBox bounds;
    for (int axis = 0; axis < 3; ++axis) {
        bounds.min[axis] = coordinate();
        bounds.max[axis] = bounds.min[axis] + *rc::gen::inRange(0, 30);
    }
    const auto lattice = make_lattice(bounds, glm::dvec3(spacing), 1'000'000'000);
    RC_ASSERT(static_cast<bool>(lattice));
    for (int a = 0; a < 3; ++a) {
        const LatticeAxis& axis = lattice->axes[a];
        const double size = bounds.size()[a];
        for (const uint64_t i : {uint64_t{0}, uint64_t{1}, axis.count - 1}) {
            if (i >= axis.count) continue;
            RC_ASSERT(static_cast<double>(static_cast<float>(axis.at(i))) == axis.at(i));
            RC_ASSERT(std::abs(axis.at(i) - bounds.center()[a]) <= 0.5 * size + 1e-3);
        }
        const double fitting = size == 0.0 ? spacing : std::min(spacing, 0.5 * size);
        RC_ASSERT(std::abs(axis.spacing - fitting) < 1e-3 * fitting);
    }
}

TEST(Lattice, AnAxisTooShortForTwoLayersHasThemAQuarterFromItsEnds) {
    const auto lattice = make_lattice({{0, 0, 0}, {8, 8, 8}}, {1000.0, 6.0, 4.0}, 100);
    ASSERT_TRUE(lattice);
    ASSERT_EQ(lattice->count(), 8u);
    EXPECT_EQ(lattice->at(0), glm::dvec3(2, 2, 2));
    EXPECT_EQ(lattice->at(7), glm::dvec3(6, 6, 6));
}

TEST(Lattice, AFlatAxisHasOneLayer) {
    const auto lattice = make_lattice({{0, 3, 0}, {4, 3, 4}}, glm::dvec3(2.0), 100);
    ASSERT_TRUE(lattice);
    ASSERT_EQ(lattice->count(), 4u);
    EXPECT_EQ(lattice->at(3), glm::dvec3(3, 3, 3));
}

TEST(Lattice, TenBillionProbesAreRefusedWithTheNumber) {
    const auto lattice = make_lattice({{0, 0, 0}, {1e4, 1e3, 1e3}}, glm::dvec3(1.0), 10'000'000);
    ASSERT_FALSE(lattice);
    EXPECT_EQ(error_text(lattice.error()),
              "a grid of 10000000000 probes is more than the limit of 10000000");
}

}  // namespace
}  // namespace tetralight
