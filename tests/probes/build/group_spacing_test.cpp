// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/group_spacing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using test::make_group;

MergedProbes merged(const std::vector<ProbeGroup>& groups) {
    auto probes = merge(groups);
    EXPECT_TRUE(probes);
    return std::move(*probes);
}

TEST(GroupSpacing, IsTheDistanceToTheNearestOtherProbe) {
    const MergedProbes probes = merged({make_group("a", test::random_positions(500, 2))});
    std::vector<uint32_t> all(500);
    std::iota(all.begin(), all.end(), 0u);
    const auto spacing = group_spacing(probes, all);
    for (uint32_t i = 0; i < 500; ++i) {
        double nearest = std::numeric_limits<double>::max();
        for (uint32_t j = 0; j < 500; ++j) {
            const double distance = glm::distance(probes.positions[i], probes.positions[j]);
            if (i != j) nearest = std::min(nearest, distance);
        }
        EXPECT_EQ(spacing[i], nearest);
    }
}

TEST(GroupSpacing, AsksNoOtherGroup) {
    const MergedProbes probes =
        merged({make_group("a", {{0, 0, 0}, {2, 0, 0}}), make_group("b", {{0, 0.1, 0}}),
                make_group("c", {{0, 0, 0}, {0, 0, 0.5}})});
    const auto of = [&](size_t source) {
        const uint32_t probe = probes.sources[source].probe;
        return group_spacing(probes, std::span(&probe, 1))[0];
    };
    EXPECT_EQ(of(0), 0.5);  // welded: of both its groups
    EXPECT_EQ(of(1), 2.0);
    EXPECT_EQ(of(2), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tetralight
