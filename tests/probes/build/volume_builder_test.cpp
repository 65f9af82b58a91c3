// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/volume_builder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include "tests/support/probe_families.h"
#include "tests/support/probe_groups.h"

namespace tetralight {
namespace {

using test::make_group;

bool is_from_scratch(VolumeBuilder& builder) {
    return *builder.build() == make_probe_volume(*merge(builder.groups()));
}

/// Positions dealt at random to groups of which each has half as many as the one before; some stand
/// in two groups.
std::vector<ProbeGroup> random_groups(const std::vector<glm::dvec3>& positions,
                                      std::mt19937_64& engine) {
    constexpr int kLast = 6;
    std::vector<ProbeGroup> groups;
    for (int i = 0; i <= kLast; ++i) groups.push_back(make_group(std::to_string(i), {}));
    for (const glm::dvec3& p : positions) {
        groups[std::min(std::countr_zero(engine()), kLast)].positions.push_back(p);
        if (engine() % 4 == 0) groups[engine() % kLast].positions.push_back(p);
    }
    return groups;
}

void add_or_remove(VolumeBuilder& builder, const ProbeGroup& group) {
    if (builder.remove_group(group.name)) return;
    EXPECT_TRUE(builder.add_group(group)) << group.name;
}

/// Adds and removes groups at random, one or several between two builds, and then all.
void add_and_remove(const std::vector<ProbeGroup>& groups, std::mt19937_64& engine) {
    VolumeBuilder builder;
    for (int step = 0; step < 30; ++step) {
        add_or_remove(builder, groups[engine() % groups.size()]);
        if (engine() % 3 == 0) continue;
        ASSERT_TRUE(is_from_scratch(builder)) << "step " << step;
    }
    while (!builder.groups().empty()) {
        add_or_remove(builder, ProbeGroup(builder.groups().back()));
        ASSERT_TRUE(is_from_scratch(builder)) << "group " << builder.groups().size();
    }
}

TEST(VolumeBuilder, GivesTheVolumeOfAllGroupsAfterAnySteps) {
    for (const auto& family : test::probe_families()) {
        for (uint64_t seed = 0; seed < 2; ++seed) {
            SCOPED_TRACE(family.name + " " + std::to_string(seed));
            std::mt19937_64 engine(seed);
            add_and_remove(random_groups(family.make(seed), engine), engine);
        }
    }
}

/// Whether adding and then removing one part of the positions gives what building anew gives.
bool is_same_there_and_back(const std::vector<glm::dvec3>& rest,
                            const std::vector<glm::dvec3>& part) {
    VolumeBuilder builder;
    if (!builder.add_group(make_group("rest", rest))) return false;
    const ProbeVolume before = *builder.build();
    if (!builder.add_group(make_group("part", part)) || !is_from_scratch(builder)) return false;
    return builder.remove_group("part") && *builder.build() == before;
}

TEST(VolumeBuilder, ChangesAFewOfManyProbesInEveryFamily) {
    for (const auto& family : test::probe_families()) {
        for (uint64_t seed = 0; seed < 6; ++seed) {
            std::vector<glm::dvec3> rest = family.make(seed);
            std::ranges::shuffle(rest, std::mt19937_64(seed));
            const size_t few = rest.size() / 20;
            const std::vector<glm::dvec3> part(rest.end() - few, rest.end());
            rest.resize(rest.size() - few);
            EXPECT_TRUE(is_same_there_and_back(rest, part)) << family.name << " " << seed;
        }
    }
}

TEST(VolumeBuilder, PutsPiecesIntoALatticeAndTakesThemOut) {
    std::vector<glm::dvec3> corner, rest;
    for (const glm::dvec3& p : test::lattice(12, 0.0, 0)) {
        (p.x < 3.5 && p.y < 3.5 && p.z < 3.5 ? corner : rest).push_back(p);
    }
    EXPECT_TRUE(is_same_there_and_back(rest, corner));
}

TEST(VolumeBuilder, TakesProbesFromTheCentreOfASphere) {
    // The centre is a vertex of every cell: all of them change.
    std::vector<glm::dvec3> sphere = test::on_a_sphere(1);
    EXPECT_TRUE(is_same_there_and_back(sphere, {{0, 0, 0}, {0.01, 0, 0}}));
}

TEST(VolumeBuilder, GoesThroughFlatSetsAndBack) {
    std::vector<glm::dvec3> flat = test::random_positions(200, 1);
    for (glm::dvec3& p : flat) p.z = 1.0;
    VolumeBuilder builder;
    ASSERT_TRUE(builder.add_group(make_group("flat", flat)));
    ASSERT_TRUE(is_from_scratch(builder));
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(builder.add_group(make_group("above", {{0, 0, 2}, {0.5, 0, 3}})));
        ASSERT_TRUE(is_from_scratch(builder));
        EXPECT_EQ(builder.build()->info.dimension, Dimension::Space);
        ASSERT_TRUE(builder.remove_group("above"));
        ASSERT_TRUE(is_from_scratch(builder));
        EXPECT_EQ(builder.build()->info.dimension, Dimension::Plane);
    }
}

TEST(VolumeBuilder, FollowsALocalSpacingThatChanges) {
    // 0.9 mm apart where probes are tens of metres apart: one probe, since 1e-4 of 10 m is 1 mm.
    // Among probes 0.1 m apart: two.
    auto sparse = test::moved(test::random_positions(100, 1), glm::dvec3(100.0), {});
    sparse.insert(sparse.end(), {{0, 0, 0}, {0.9e-3, 0, 0}});
    VolumeBuilder builder;
    ASSERT_TRUE(builder.add_group(make_group("sparse", sparse)));
    EXPECT_EQ(builder.build()->positions.size(), 101u);
    const auto dense = test::moved(test::random_positions(20, 2), glm::dvec3(0.1), {});
    ASSERT_TRUE(builder.add_group(make_group("dense", dense)));
    EXPECT_EQ(builder.build()->positions.size(), 122u);
    ASSERT_TRUE(is_from_scratch(builder));
    ASSERT_TRUE(builder.remove_group("dense"));
    ASSERT_TRUE(is_from_scratch(builder));
    EXPECT_EQ(builder.build()->positions.size(), 101u);
}

TEST(VolumeBuilder, TakesTheSettingsOfMerge) {
    const MergeSettings settings{0.1};
    VolumeBuilder builder(settings);
    ASSERT_TRUE(builder.add_group(make_group("a", test::random_positions(100, 2))));
    EXPECT_EQ(*builder.build(), make_probe_volume(*merge(builder.groups(), settings)));
}

TEST(VolumeBuilder, ChangesNothingAfterAnError) {
    VolumeBuilder builder;
    ASSERT_TRUE(builder.add_group(make_group("a", test::random_positions(50, 3))));
    const ProbeVolume before = *builder.build();
    EXPECT_EQ(
        error_text(builder.add_group(make_group("b", {{0, 0, 0}, {0, std::nan(""), 0}})).error()),
        "group \"b\": probe 1: position is not finite (0, nan, 0)");
    EXPECT_EQ(error_text(builder.add_group(make_group("a", {{0, 0, 0}})).error()),
              "group \"a\": there are two groups of this name");
    EXPECT_FALSE(builder.add_group(make_group("", {{0, 0, 0}})));
    EXPECT_EQ(error_text(builder.remove_group("b").error()), "group \"b\": there is no such group");
    EXPECT_EQ(builder.groups().size(), 1u);
    EXPECT_EQ(*builder.build(), before);
}

TEST(VolumeBuilder, OfNothingIsEmpty) {
    VolumeBuilder builder;
    EXPECT_EQ(*builder.build(), make_probe_volume(MergedProbes{}));
}

}  // namespace
}  // namespace tetralight
