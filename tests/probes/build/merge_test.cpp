// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/merge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/probe_families.h"
#include "tests/support/probe_groups.h"

namespace tetralight {
namespace {

using test::make_group;

TEST(Merge, PutsPositionsInWorldSpace) {
    ProbeGroup group = make_group("a", {{1, 0, 0}, {0, 1, 0}});
    group.world_from_group = glm::translate(glm::dmat4(1.0), glm::dvec3(10, 20, 30));
    const auto merged = merge(std::span(&group, 1));
    ASSERT_TRUE(merged);
    EXPECT_EQ(merged->positions[merged->sources[0].probe], glm::dvec3(11, 20, 30));
    EXPECT_EQ(merged->positions[merged->sources[1].probe], glm::dvec3(10, 21, 30));
}

TEST(Merge, IsTheSameForEveryOrderOfTheGroups) {
    std::vector<ProbeGroup> groups{make_group("c", test::random_positions(20, 1)),
                                   make_group("a", test::random_positions(30, 2)),
                                   make_group("b", test::random_positions(10, 3))};
    const auto first = merge(groups);
    std::swap(groups[0], groups[2]);
    std::swap(groups[0], groups[1]);
    const auto second = merge(groups);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->positions, second->positions);
    EXPECT_EQ(first->sources, second->sources);
    EXPECT_EQ(first->group_names, (std::vector<std::string>{"a", "b", "c"}));
}

TEST(Merge, NoProbeIsLost) {
    const std::vector<ProbeGroup> groups{make_group("a", test::random_positions(500, 4)),
                                         make_group("b", test::random_positions(300, 5))};
    const auto merged = merge(groups);
    ASSERT_TRUE(merged);
    ASSERT_EQ(merged->sources.size(), 800u);
    for (const ProbeSource& source : merged->sources) {
        EXPECT_EQ(merged->positions[source.probe], groups[source.group].positions[source.index]);
    }
}

TEST(Merge, WeldsDuplicatesAndSaysSo) {
    const std::vector<ProbeGroup> groups{make_group("a", {{0, 0, 0}, {1, 1, 1}}),
                                         make_group("b", {{1, 1, 1}, {0, 0, -0.0}, {2, 0, 0}})};
    const auto merged = merge(groups);
    ASSERT_TRUE(merged);
    EXPECT_EQ(merged->positions.size(), 3u);
    EXPECT_EQ(merged->welded_count(), 2u);
    EXPECT_EQ(merged->sources[1].probe, merged->sources[2].probe);
}

TEST(Merge, KeepsTheRenderingLayersOfEachGroup) {
    std::vector<ProbeGroup> groups{make_group("b", {{0, 0, 0}}), make_group("a", {{1, 1, 1}})};
    groups[0].rendering_layers = 0b01;
    const auto merged = merge(groups);
    ASSERT_TRUE(merged);
    EXPECT_EQ(merged->group_rendering_layers, (std::vector<uint32_t>{kAllRenderingLayers, 0b01}));
}

TEST(Merge, RefusesAGroupOnNoRenderingLayer) {
    std::vector<ProbeGroup> groups{make_group("b", {{0, 0, 0}}), make_group("a", {{1, 1, 1}})};
    groups[1].rendering_layers = 0;
    const auto merged = merge(groups);
    ASSERT_FALSE(merged);
    EXPECT_EQ(merged.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(merged.error().field, "groups[1].rendering_layers");
    EXPECT_EQ(error_text(merged.error()), "group \"a\": it is on no rendering layer");
}

TEST(Merge, WeldsTensOfThousandsOfEqualProbes) {
    const ProbeGroup group = make_group("heap", std::vector<glm::dvec3>(50'000, glm::dvec3(1.0)));
    const auto merged = merge(std::span(&group, 1));
    ASSERT_TRUE(merged);
    EXPECT_EQ(merged->positions.size(), 1u);
    EXPECT_EQ(merged->welded_count(), 49'999u);
}

TEST(Merge, KeepsTheSmallestPositionOfAClusterWhateverItsGroup) {
    // All within 1e-3 of each other, beside a row that makes the spacing there about 1.
    std::vector<glm::dvec3> row;
    for (int i = 1; i <= 10; ++i) row.emplace_back(0.25 * i, 0.1 * i * i, 0.0);
    std::vector<ProbeGroup> groups{make_group("a", {{1e-4, 0, 0}, {0, 1e-4, 0}}),
                                   make_group("b", {{0, 0, 1e-4}, {0, 0, 1e-4}}),
                                   make_group("row", row)};
    const auto merged = merge(groups, {1e-2});
    std::swap(groups[0], groups[2]);
    std::ranges::reverse(groups[2].positions);
    const auto reordered = merge(groups, {1e-2});
    ASSERT_TRUE(merged && reordered);
    EXPECT_EQ(merged->positions.size(), 11u);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(merged->positions[merged->sources[i].probe], glm::dvec3(0, 0, 1e-4));
    }
    EXPECT_EQ(reordered->positions, merged->positions);
}

TEST(Merge, NoTwoProbesAreWithinTheWeldRadius) {
    for (const test::ProbeFamily& family : test::probe_families()) {
        const ProbeGroup group = make_group("a", family.make(1));
        const auto merged = merge(std::span(&group, 1));
        ASSERT_TRUE(merged);
        for (size_t i = 0; i < merged->positions.size(); ++i) {
            for (size_t j = 0; j < i; ++j) {
                const double distance = glm::distance(merged->positions[i], merged->positions[j]);
                ASSERT_GE(distance, merged->weld_radius) << family.name;
            }
        }
    }
}

TEST(Merge, SourcesAreSortedByGroupThenIndex) {
    const std::vector<ProbeGroup> groups{make_group("b", {{1, 1, 1}, {0, 0, 0}}),
                                         make_group("a", {{1, 1, 1}, {1, 1, 1}})};
    const auto merged = merge(groups);
    ASSERT_TRUE(merged);
    const uint32_t probe = merged->sources[0].probe;
    EXPECT_EQ(
        merged->sources,
        (std::vector<ProbeSource>{{0, 0, probe}, {0, 1, probe}, {1, 0, probe}, {1, 1, 1 - probe}}));
}

TEST(Merge, SnapsEachLatticeByItselfAndSaysWhich) {
    const auto turned = test::turned(test::lattice(6, 0.0, 0), 0.7);
    const ProbeGroup lattice = make_group("b", turned);
    const std::vector<ProbeGroup> groups{make_group("a", test::random_positions(50, 1)), lattice};
    const auto both = merge(groups);
    const auto alone = merge(std::span(&lattice, 1));
    ASSERT_TRUE(both && alone);
    EXPECT_EQ(both->group_is_lattice, (std::vector<bool>{false, true}));
    EXPECT_EQ(both->largest_snap, alone->largest_snap);
    EXPECT_GT(both->largest_snap, 0.0);
    for (size_t i = 0; i < turned.size(); ++i) {
        const glm::dvec3& snapped = both->positions[both->sources[50 + i].probe];
        EXPECT_EQ(snapped, alone->positions[alone->sources[i].probe]);
        EXPECT_LE(glm::distance(snapped, turned[i]), both->largest_snap);
    }
}

TEST(Merge, NamesTheProbeThatIsNotFinite) {
    const ProbeGroup group = make_group("hall", {{0, 0, 0}, {0, std::nan(""), 1}});
    const auto merged = merge(std::span(&group, 1));
    ASSERT_FALSE(merged);
    EXPECT_EQ(error_text(merged.error()),
              "group \"hall\": probe 1: position is not finite (0, nan, 1)");
}

TEST(Merge, RefusesPositionsBeyondAllScenes) {
    const ProbeGroup group = make_group("far", {{2e18, 0, 0}});
    EXPECT_FALSE(merge(std::span(&group, 1)));
}

TEST(Merge, RefusesNamesThatAreMissingDoubleOrBroken) {
    EXPECT_FALSE(merge(std::vector{make_group("", {{0, 0, 0}})}));
    for (const char* name : {"a\nb", "a\tb", "\x1b[2J", "\x7f", "\xff"}) {
        EXPECT_FALSE(merge(std::vector{make_group(name, {{0, 0, 0}})})) << name;
    }
    EXPECT_TRUE(merge(std::vector{make_group("\xc3\xa4 b", {{0, 0, 0}})}));
    const auto twice =
        merge(std::vector{make_group("a", {}), make_group("b", {}), make_group("a", {})});
    ASSERT_FALSE(twice);
    EXPECT_EQ(error_text(twice.error()), "group \"a\": there are two groups of this name");
}

TEST(Merge, OfNothingIsNothing) {
    const auto merged = merge({});
    ASSERT_TRUE(merged);
    EXPECT_TRUE(merged->positions.empty());
}

}  // namespace
}  // namespace tetralight
