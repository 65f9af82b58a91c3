// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/weld.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include <tetralight/probes/build/hilbert_order.h>
#include "tests/support/probe_families.h"

namespace tetralight::detail {
namespace {

std::vector<glm::dvec3> along_curve(const std::vector<glm::dvec3>& positions) {
    std::vector<glm::dvec3> sorted;
    for (const uint32_t i : hilbert_order(positions)) {
        if (sorted.empty() || sorted.back() != positions[i]) sorted.push_back(positions[i]);
    }
    return sorted;
}

/// What is left of positions after a weld.
std::vector<glm::dvec3> left_of(const std::vector<glm::dvec3>& positions, double tolerance) {
    const auto sorted = along_curve(positions);
    const Weld result = weld(sorted, tolerance);
    std::vector<glm::dvec3> left;
    for (uint32_t i = 0; i < sorted.size(); ++i) {
        if (result.representatives[i] == i) left.push_back(sorted[i]);
    }
    return left;
}

TEST(Weld, KeepsARoomWhateverStandsFarAway) {
    const auto room = test::random_positions(1000, 1);
    for (const double distance : {1e3, 1e6, 1e9, 1e15}) {
        const auto all = test::joined(room, {{distance, -distance, distance}});
        EXPECT_EQ(left_of(all, 1e-4).size(), 1001u) << distance;
    }
}

TEST(Weld, ASparseNeighborhoodDoesNotSwallowADenseCluster) {
    // 0.1 mm apart among probes 100 m apart: a tolerance of 1e-4 is 1 mm for those, 10 nm for
    // these.
    const auto sparse = test::moved(test::lattice(10, 0.0, 0), glm::dvec3(100.0), {});
    const auto dense = test::moved(test::lattice(5, 0.0, 0), glm::dvec3(1e-4), {5, 4, 6});
    EXPECT_EQ(left_of(test::joined(sparse, dense), 1e-4).size(), 1125u);
}

TEST(Weld, JoinsPairsWithinTheToleranceOfTheLocalSpacing) {
    // The seventh nearest position of a cubic lattice is one of twelve at √2 spacings; with a twin
    // beside each probe it is the third of twelve at one spacing.
    const auto lattice = test::lattice(6, 0.0, 0);
    const auto near = test::moved(lattice, glm::dvec3(1), {0.9e-2, 0, 0});
    const auto far = test::moved(lattice, glm::dvec3(1), {2e-2, 0, 0});
    EXPECT_EQ(left_of(test::joined(lattice, near), 1e-2), along_curve(lattice));
    EXPECT_EQ(left_of(test::joined(lattice, far), 1e-2).size(), 2 * lattice.size());
}

TEST(Weld, JoinsWhatFloatsCannotTellApartAtAnyTolerance) {
    // A kilometre from the origin of a scene a float's step is 61 µm.
    const auto scene = test::moved(test::random_positions(1000, 2), glm::dvec3(1000.0), {});
    const auto all = test::joined(scene, test::moved(scene, glm::dvec3(1), {1e-6, 0, 0}));
    EXPECT_GE(left_of(all, 0.0).size(), 1000u);
    EXPECT_LE(left_of(all, 0.0).size(), 1001u);  // but near the very origin
}

TEST(Weld, AProbeFarAwayDoesNotScaleAFewOthers) {
    // 1e-4 of 10 km would be a metre.
    const std::vector<glm::dvec3> room{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
    for (size_t count = 1; count <= room.size(); ++count) {
        const std::vector<glm::dvec3> near(room.begin(), room.begin() + count);
        const auto all = test::joined(near, {{1e4, 1e4, 1e4}});
        EXPECT_EQ(left_of(all, 1e-4).size(), count + 1);
    }
}

TEST(Weld, APairFarFromAllOthersStaysAPair) {
    const auto town = test::random_positions(100, 1);
    const auto all = test::joined(town, {{1e4, 0, 0}, {1e4, 0.5, 0}});
    EXPECT_EQ(left_of(all, 1e-4).size(), 102u);
}

TEST(Weld, ReachesNoFartherThanItDoesAtTenMetres) {
    // Probes 200 m apart and more around a pair: 1e-4 of 10 m is 1 mm, 0.1 of it 1 m.
    const auto field = test::moved(test::lattice(3, 0.0, 0), glm::dvec3(200), glm::dvec3(-200));
    for (const auto& [tolerance, reach] : {std::pair(1e-4, 1e-3), {0.1, 1.0}}) {
        const auto with_twin = [&](double distance) {
            return left_of(test::joined(field, {{distance, 0, 0}}), tolerance).size();
        };
        EXPECT_EQ(with_twin(0.9 * reach), field.size());
        EXPECT_EQ(with_twin(1.1 * reach), field.size() + 1);
    }
}

TEST(Weld, ClosesClustersTransitively) {
    // Ten in a row at 0.06; the seventh nearest is 0.24 (in the middle) to 0.42 away (at the ends).
    std::vector<glm::dvec3> row;
    for (int i = 0; i < 10; ++i) row.emplace_back(0.06 * i, 0.0, 0.0);
    EXPECT_EQ(left_of(row, 0.3), std::vector<glm::dvec3>{row[0]});
    EXPECT_EQ(left_of(row, 0.1).size(), 10u);
}

TEST(Weld, CloudsOfNearDuplicatesTakeNoTime) {
    // Seen from the bulk of the probes, a float's step is larger than the first cloud, and smaller
    // than the distances in the second, which is one chain after the other.
    const auto bulk = test::random_positions(150'000, 3);
    const auto point =
        test::moved(test::random_positions(100'000, 4, 1e-9), glm::dvec3(1), {3, 0, 0});
    const auto cloud =
        test::moved(test::random_positions(100'000, 5, 2e-6), glm::dvec3(1), {0, 3, 0});
    EXPECT_EQ(left_of(test::joined(bulk, point), 1e-4).size(), bulk.size() + 1);
    const size_t left = left_of(test::joined(bulk, cloud), 1e-4).size();
    EXPECT_GE(left, bulk.size() + 1);
    EXPECT_LT(left, bulk.size() + 100);
}

RC_GTEST_PROP(Weld, LeavesNothingWithinItsRadius, ()) {
    const auto seed = *rc::gen::inRange<uint64_t>(1, 1'000'000);
    const auto count = *rc::gen::inRange<size_t>(1, 300);
    const double tolerance = *rc::gen::element(0.0, 1e-4, 0.1, 0.5);
    const auto sorted = along_curve(test::random_positions(count, seed));
    const Weld result = weld(sorted, tolerance);
    for (uint32_t i = 0; i < sorted.size(); ++i) {
        const uint32_t r = result.representatives[i];
        RC_ASSERT(result.representatives[r] == r);
        for (uint32_t j = 0; j < i; ++j) {
            if (result.representatives[j] == r) continue;
            RC_ASSERT(glm::distance(sorted[i], sorted[j]) > result.radius);
        }
    }
}

}  // namespace
}  // namespace tetralight::detail
