// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/merge_warnings.h>

#include <gtest/gtest.h>

#include <tetralight/probes/build/tetrahedralize.h>
#include "tests/support/probe_groups.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using test::make_group;

using Lines = std::vector<std::string>;

Lines warnings_of(const std::vector<ProbeGroup>& groups) {
    const MergedProbes merged = *merge(groups);
    const auto cells = tetrahedralize(merged.positions, flat_tolerance(merged));
    return merge_warnings(merged, cells.dimension);
}

TEST(MergeWarnings, SayNothingOfAnOrdinarySet) {
    EXPECT_EQ(warnings_of({make_group("a", test::random_positions(100, 1))}), Lines{});
}

TEST(MergeWarnings, NameGroupsWithoutAProbe) {
    EXPECT_EQ(warnings_of({make_group("b", {}), make_group("a", {{0, 0, 0}})}),
              Lines{"group \"b\" has no probes"});
}

TEST(MergeWarnings, SayWhyAGroupHasNoProbes) {
    ProbeGroup group = make_group("b", {});
    group.empty_warning = "s.glb: b has no points";
    EXPECT_EQ(warnings_of({group, make_group("a", {{0, 0, 0}})}), Lines{"s.glb: b has no points"});
}

TEST(MergeWarnings, SayThatThereAreNoProbes) {
    const std::string none = "there are no probes: the volume answers with its ambient light alone";
    EXPECT_EQ(warnings_of({}), Lines{none});
    EXPECT_EQ(warnings_of({make_group("a", {})}), (Lines{"group \"a\" has no probes", none}));
}

TEST(MergeWarnings, SayThatMostProbesWereWelded) {
    const auto positions = test::random_positions(10, 1);
    const auto twice = make_group("b", positions);
    EXPECT_EQ(warnings_of({make_group("a", positions), twice}), Lines{});  // half of them
    EXPECT_EQ(warnings_of({make_group("a", positions), twice, make_group("c", positions)}),
              Lines{"20 of 30 probes were welded to others (is a group there twice?)"});
}

/// Probes about a metre apart near a plane. A millionth of the size, about 30 µm, was meant to be
/// flat.
std::vector<glm::dvec3> slab(double thickness) {
    auto positions = test::random_positions(400, 2, 10.0);
    for (glm::dvec3& p : positions) p.y *= thickness / 20.0;
    return positions;
}

TEST(MergeWarnings, SayThatASetCountsAsFlatThoughItIsNot) {
    EXPECT_EQ(warnings_of({make_group("a", slab(1e-3))}), Lines{});
    EXPECT_EQ(warnings_of({make_group("a", slab(1e-6))}), Lines{});
    EXPECT_EQ(warnings_of({make_group("a", slab(0.0))}), Lines{});
    // A tenth of a millimetre; the weld radius of sets so wide is 1e-4 of 10 m.
    EXPECT_EQ(warnings_of({make_group("a", {{0, 0, 0}, {10, 0, 0}, {0, 0, 10}, {10, 1e-4, 10}})}),
              Lines{"4 probes lie in one plane (thinner than 0.001 m): the volume is made of "
                    "triangles"});
    EXPECT_EQ(warnings_of({make_group("a", {{0, 0, 0}, {10, 0, 0}, {5, 1e-4, 0}})}),
              Lines{"3 probes lie on one line (thinner than 0.001 m): the volume is made of "
                    "segments"});
}

}  // namespace
}  // namespace tetralight
