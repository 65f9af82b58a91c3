// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/snap_to_lattice.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include <tetralight/probes/delaunay/exact_signs.h>
#include "tests/support/probe_families.h"

namespace tetralight::detail {
namespace {

using Positions = std::vector<glm::dvec3>;

constexpr glm::dvec3 kFarOffset(1234.5, -321.7, 2718.28);

Positions as_floats(Positions positions) {
    for (glm::dvec3& p : positions) p = glm::dvec3(glm::vec3(p));
    return positions;
}

/// A lattice of `side`³, number x + side (y + side z), turned and far from the origin.
Positions turned_lattice(int side, double angle) {
    return test::moved(test::turned(test::lattice(side, 0.0, 0), angle), glm::dvec3(1), kFarOffset);
}

TEST(SnapToLattice, LeavesExactGridsAsTheyAre) {
    for (const glm::dvec3& spacing : {glm::dvec3(1), glm::dvec3(0.1, 0.3, 2.0 / 3.0)}) {
        const Positions grid = test::moved(test::lattice(6, 0.0, 0), spacing, {0.3, -7.7, 100.1});
        for (const Positions& exact : {grid, as_floats(grid), test::with_holes(grid, 0.3, 1)}) {
            Positions snapped = exact;
            EXPECT_EQ(snap_to_lattice(snapped), 0.0);
            EXPECT_EQ(snapped, exact);
        }
    }
}

TEST(SnapToLattice, MovesByAFewFloatStepsAtMost) {
    for (const double angle : {0.1, 0.7, 3.0}) {
        const Positions lattice = turned_lattice(8, angle);
        for (const Positions& positions : {lattice, as_floats(lattice)}) {
            Positions snapped = positions;
            const auto longest = snap_to_lattice(snapped);
            ASSERT_TRUE(longest);
            double measured = 0.0;
            for (size_t i = 0; i < positions.size(); ++i) {
                measured = std::max(measured, glm::distance(positions[i], snapped[i]));
            }
            EXPECT_EQ(*longest, measured);
            EXPECT_LE(*longest, 3.0 * 0x1p-23 * 2800.0);
        }
    }
}

TEST(SnapToLattice, LinesAndPlanesAreExactlyStraight) {
    constexpr int kSide = 8;
    Positions p = as_floats(turned_lattice(kSide, 0.7));
    ASSERT_TRUE(snap_to_lattice(p));
    const auto at = [&](int x, int y, int z) { return p[x + kSide * (y + kSide * z)]; };
    for (int i = 2; i < kSide; ++i) {
        // Coplanar with any fourth position = collinear.
        EXPECT_EQ(exact_orientation(at(0, 3, 4), at(1, 3, 4), at(i, 3, 4), at(5, 7, 1)), 0);
        EXPECT_EQ(exact_orientation(at(3, 0, 4), at(3, 1, 4), at(3, i, 4), at(5, 7, 1)), 0);
        EXPECT_EQ(exact_orientation(at(3, 4, 0), at(3, 4, 1), at(3, 4, i), at(5, 7, 1)), 0);
        EXPECT_EQ(exact_orientation(at(i, 0, 0), at(0, i, 0), at(i - 1, i, 0), at(7, 7, 0)), 0);
        EXPECT_EQ(exact_orientation(at(i, 2, 0), at(0, 2, i), at(i - 1, 2, i), at(7, 2, 7)), 0);
    }
}

TEST(SnapToLattice, LatticesTurnedAlikeKeepCommonPlanes) {
    // The second one has another spacing, size and origin, but its floor is that of the first.
    const Positions first = test::moved(test::lattice(6, 0.0, 0), glm::dvec3(0.5), {0.3, 0.3, 0.3});
    const Positions second = test::moved(test::lattice(9, 0.0, 0), {0.7, 0.6, 0.9}, {4.1, -2, 0.3});
    Positions a = test::turned(first, 0.7), b = test::turned(second, 0.7);
    ASSERT_TRUE(snap_to_lattice(a) && snap_to_lattice(b));
    for (size_t i = 0; i < 81; ++i) EXPECT_EQ(exact_orientation(a[0], a[5], a[35], b[i]), 0);
}

TEST(SnapToLattice, LeavesExactLatticesThatAreNotRectangular) {
    // One probe in the middle of a cube makes a centred lattice of all.
    const Positions exact = test::joined(test::lattice(6, 0.0, 0), {{2.5, 2.5, 2.5}});
    Positions snapped = exact;
    EXPECT_EQ(snap_to_lattice(snapped), 0.0);
    EXPECT_EQ(snapped, exact);
}

TEST(SnapToLattice, FineLatticesFarAwayKeepTheirShape) {
    // 1 mm apart, 3 km away, in doubles: here a float's step is half of the spacing.
    Positions p = test::turned(test::moved(test::lattice(8, 0.0, 0), glm::dvec3(1e-3), {}), 0.7);
    p = test::moved(p, glm::dvec3(1), kFarOffset);
    const auto longest = snap_to_lattice(p);
    ASSERT_TRUE(longest);
    EXPECT_LE(*longest, 1e-6);
    EXPECT_EQ(exact_orientation(p[0], p[7], p[63], p[56]), 0);
    EXPECT_EQ(exact_orientation(p[0], p[1], p[5], p[300]), 0);
}

TEST(SnapToLattice, KnowsFlatAndStraightLattices) {
    const Positions cube = test::lattice(9, 0.0, 0);
    Positions plane = test::turned(Positions(cube.begin(), cube.begin() + 81), 0.7);
    ASSERT_TRUE(snap_to_lattice(plane));
    for (const glm::dvec3& p : plane)
        EXPECT_EQ(exact_orientation(plane[0], plane[8], plane[80], p), 0);
    Positions line = test::turned(Positions(cube.begin(), cube.begin() + 9), 0.7);
    ASSERT_TRUE(snap_to_lattice(line));
    for (const glm::dvec3& p : line) {
        EXPECT_EQ(exact_orientation(line[0], line[8], p, glm::dvec3(5, -3, 1)), 0);
    }
}

TEST(SnapToLattice, LeavesWhatIsNoLattice) {
    const glm::dvec3 one(1.0);
    for (const Positions& positions :
         {test::random_positions(1000, 1), test::random_positions(8, 2),
          as_floats(test::random_positions(500, 3)), test::lattice(8, 1e-5, 4),
          test::moved(test::lattice(8, 1e-2, 5), one, kFarOffset),
          test::moved(test::random_positions(300, 6), {1, 1, 0}, {}),
          test::moved(test::random_positions(100, 7), {1, 0, 0}, {}), test::on_a_sphere(8),
          Positions(50, one), Positions{}, test::turned(Positions(7, one), 1.0),
          test::joined(test::lattice(8, 0.0, 0), {{3.31, 3.73, 3.12}})}) {
        Positions snapped = positions;
        EXPECT_FALSE(snap_to_lattice(snapped)) << positions.size();
        EXPECT_EQ(snapped, positions);
    }
}

TEST(SnapToLattice, LeavesPositionsThatWereTypedInCentimetres) {
    Positions positions = test::moved(test::random_positions(300, 9), glm::dvec3(500.0), {});
    for (glm::dvec3& p : positions) p = glm::round(p) * 0.01;
    EXPECT_FALSE(snap_to_lattice(positions));
}

RC_GTEST_PROP(SnapToLattice, FindsLatticesOfAnySpacingWithHolesUnderAnyTransform, ()) {
    const auto seed = *rc::gen::inRange<uint64_t>(1, 1'000'000);
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> spacing(0.5, 4.0), offset(-1000.0, 1000.0);
    const glm::dvec3 steps(spacing(engine), spacing(engine), spacing(engine));
    const Positions lattice = test::with_holes(test::lattice(6, 0.0, 0), 0.4, seed);
    Positions positions = test::turned(test::moved(lattice, steps, {}), spacing(engine));
    const glm::dvec3 origin(offset(engine), offset(engine), offset(engine));
    positions = as_floats(test::moved(positions, glm::dvec3(1), origin));
    const auto longest = snap_to_lattice(positions);
    RC_ASSERT(longest.has_value());
    RC_ASSERT(*longest <= 1e-3);
}

RC_GTEST_PROP(SnapToLattice, DoesNotDependOnTheOrderOfThePositions, ()) {
    const auto seed = *rc::gen::inRange<uint64_t>(1, 1'000'000);
    const auto holes = *rc::gen::inRange(0, 7);
    const Positions lattice =
        test::with_holes(turned_lattice(6, static_cast<double>(seed)), 0.1 * holes, seed);
    Positions forward = as_floats(lattice);
    Positions backward(forward.rbegin(), forward.rend());
    RC_ASSERT(snap_to_lattice(forward) == snap_to_lattice(backward));
    std::ranges::reverse(backward);
    RC_ASSERT(forward == backward);
}

}  // namespace
}  // namespace tetralight::detail
