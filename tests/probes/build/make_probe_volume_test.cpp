// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/make_probe_volume.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/quality.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

TEST(MakeProbeVolume, IsSoundAndValid) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(1000, 1));
    const auto status = verify(volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
    EXPECT_TRUE(validate(volume.view()).problems().empty());
}

TEST(MakeProbeVolume, GivesTheSameBytesForEveryOrderOfTheGroups) {
    std::vector<ProbeGroup> groups(3);
    for (size_t i = 0; i < 3; ++i) {
        groups[i].name = std::string(1, static_cast<char>('a' + i));
        groups[i].positions = test::random_positions(50, i);
    }
    const auto bytes = [&] { return probe_file_bytes(make_probe_volume(*merge(groups)).view()); };
    const auto first = bytes();
    std::swap(groups[0], groups[2]);
    EXPECT_EQ(bytes(), first);
}

TEST(MakeProbeVolume, PutsAWeldedProbeOnTheRenderingLayersOfAllItsGroups) {
    std::vector<ProbeGroup> groups(2);
    groups[0].name = "a";
    groups[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    groups[0].rendering_layers = 0b001;
    groups[1].name = "b";
    groups[1].positions = {{1, 0, 0}, {0, 0, 1}};
    groups[1].rendering_layers = 0b100;
    const ProbeVolume volume = make_probe_volume(*merge(groups));
    ASSERT_EQ(volume.rendering_layers.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        const glm::dvec3& p = volume.exact_positions[i];
        const bool is_in_a = p.z == 0.0, is_in_b = p.x == 1.0 || p.z == 1.0;
        EXPECT_EQ(volume.rendering_layers[i], (is_in_a ? 0b001u : 0u) | (is_in_b ? 0b100u : 0u));
    }
    EXPECT_TRUE(verify(volume.view()));
}

TEST(MakeProbeVolume, HasNoRenderingLayersIfAllGroupsAreOnAll) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 3));
    EXPECT_TRUE(volume.rendering_layers.empty());
}

TEST(MakeProbeVolume, MovesTheLocalOriginOnlyFarAway) {
    std::vector<glm::dvec3> near = test::random_positions(50, 2);
    EXPECT_EQ(test::make_lit_volume(near).info.world_origin, glm::dvec3(0.0));
    for (glm::dvec3& p : near) p.x += 1e5;
    const ProbeVolume far = test::make_lit_volume(near);
    EXPECT_NEAR(far.info.world_origin.x, 1e5, 2.0);
    EXPECT_TRUE(validate(far.view()).problems().empty());
}

/// Slivers among the tetrahedra over one group.
QualityReport quality_over(std::vector<glm::dvec3> positions) {
    const ProbeVolume volume = test::make_lit_volume(std::move(positions));
    EXPECT_TRUE(validate(volume.view()).problems().empty());
    EXPECT_EQ(volume.info.dimension, Dimension::Space);
    const auto cells = std::span(volume.cells).first(volume.info.inner_cell_count);
    return measure_quality(volume.exact_positions, cells);
}

TEST(MakeProbeVolume, MakesNoSliversInALatticeHoweverItStands) {
    const auto lattice = test::lattice(12, 0.0, 0);
    for (const glm::dvec3& spacing : {glm::dvec3(1), glm::dvec3(0.5, 0.3, 2.0)}) {
        for (const double angle : {0.1, 0.7, 2.0}) {
            for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(123.4, -56.7, 3000.1)}) {
                auto positions = test::turned(test::moved(lattice, spacing, {}), angle);
                positions = test::moved(positions, glm::dvec3(1), offset);
                EXPECT_EQ(quality_over(positions).slivers, 0u) << angle << " " << offset.z;
                for (glm::dvec3& p : positions) p = glm::dvec3(glm::vec3(p));
                EXPECT_EQ(quality_over(positions).slivers, 0u) << angle << " " << offset.z;
            }
        }
    }
}

TEST(MakeProbeVolume, MakesHardlyAnySliverInALatticeWithHoles) {
    // Lines across the steps are only as straight as rounding leaves them, unless the spacing is a
    // power of two.
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        const auto lattice = test::with_holes(test::lattice(12, 0.0, 0), 0.3, seed);
        const auto angle = static_cast<double>(seed);
        EXPECT_EQ(quality_over(test::turned(lattice, angle)).slivers, 0u);
        const auto typed = test::moved(lattice, glm::dvec3(0.1), {0.3, 0.7, 0.9});
        EXPECT_LE(quality_over(typed).sliver_fraction(), 0.005);
        EXPECT_LE(quality_over(test::turned(typed, angle)).sliver_fraction(), 0.005);
    }
}

TEST(MakeProbeVolume, MakesNoSliversInLatticesThatAreNotRectangular) {
    const auto cubes = test::lattice(9, 0.0, 0);
    const auto centred = test::joined(cubes, test::moved(cubes, glm::dvec3(1), glm::dvec3(0.5)));
    auto sheared = cubes;
    for (glm::dvec3& p : sheared) p += glm::dvec3(0.5 * p.y, 0.0, 0.3 * p.y);
    for (const auto& lattice : {centred, sheared}) {
        EXPECT_EQ(quality_over(lattice).slivers, 0u);
        EXPECT_EQ(quality_over(test::turned(lattice, 0.7)).slivers, 0u);
        EXPECT_EQ(quality_over(test::turned(test::with_holes(lattice, 0.3, 1), 0.7)).slivers, 0u);
    }
}

TEST(MakeProbeVolume, MakesNoSliversBetweenLatticesThatWereTurnedAlike) {
    std::vector<ProbeGroup> groups(2);
    const auto lattice = test::moved(test::lattice(8, 0.0, 0), glm::dvec3(0.3), {1.1, 2.2, 3.3});
    groups[0] = {"a", glm::dmat4(1.0), test::turned(lattice, 0.7)};
    groups[1] = {"b", glm::dmat4(1.0),
                 test::turned(test::moved(lattice, glm::dvec3(1), {2.4, 0, 0}), 0.7)};
    const ProbeVolume volume = make_probe_volume(*merge(groups));
    const auto cells = std::span(volume.cells).first(volume.info.inner_cell_count);
    EXPECT_EQ(measure_quality(volume.exact_positions, cells).slivers, 0u);
}

TEST(MakeProbeVolume, OfNothingHasNoCells) {
    const auto volume = make_probe_volume(MergedProbes{});
    EXPECT_TRUE(volume.cells.empty());
    EXPECT_TRUE(verify(volume.view()));
}

}  // namespace
}  // namespace tetralight
