// SPDX-License-Identifier: Apache-2.0
// Our tetrahedra, and those of CGAL and TetGen, over the same probes.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/programs/tetrahedralize_with_program.h>
#include "tests/support/probe_families.h"
#include "tests/support/unique_delaunay.h"

namespace tetralight {
namespace {

const TetrahedraProgram kCgal{TETRALIGHT_CGAL_PROGRAM};
const TetrahedraProgram kTetgen{TETRALIGHT_TETGEN_PROGRAM};

MergedProbes merged(std::vector<glm::dvec3> positions) {
    ProbeGroup group;
    group.name = "test";
    group.positions = std::move(positions);
    return *merge(std::span(&group, 1));
}

/// Holds that CGAL gives our volume, and TetGen too, or, where there are several, an equally good
/// one.
void expect_agreement(const MergedProbes& probes) {
    const auto ours = tetrahedralize(probes.positions, flat_tolerance(probes));
    const auto cgals = tetrahedralize_with_program(probes.positions, flat_tolerance(probes), kCgal);
    ASSERT_TRUE(cgals) << error_text(cgals.error());
    EXPECT_TRUE(*cgals == ours);
    const auto theirs =
        tetrahedralize_with_program(probes.positions, flat_tolerance(probes), kTetgen);
    ASSERT_TRUE(theirs) << error_text(theirs.error());
    ASSERT_EQ(theirs->dimension, ours.dimension);
    if (ours.dimension != Dimension::Space || test::is_unique_delaunay(ours, probes.positions)) {
        EXPECT_EQ(*theirs, ours);
        return;
    }
    const auto our_report = validate(make_probe_volume(probes, ours).view());
    const auto their_report = validate(make_probe_volume(probes, *theirs).view());
    for (const std::string& problem : their_report.problems()) ADD_FAILURE() << problem;
    const double rounding = 1e-12 * our_report.hull_measure;
    EXPECT_NEAR(their_report.hull_measure, our_report.hull_measure, rounding);
    EXPECT_NEAR(their_report.cell_measure, our_report.cell_measure, rounding);
}

/// Sets in which Delaunay tetrahedra are hardest to choose, or most of them are slivers.
std::vector<test::ProbeFamily> hard_families() {
    using P = std::vector<glm::dvec3>;
    return {
        {"cylinder",
         [](uint64_t s) {
             P positions;
             for (int i = 0; i < 192; ++i) {
                 const double angle = glm::radians(15.0 * (i % 24));
                 positions.emplace_back(std::cos(angle), std::sin(angle),
                                        static_cast<double>(s) * 0.3 * (i / 24));
             }
             return positions;
         }},
        {"integers on a sphere",
         [](uint64_t) {
             P positions;
             for (const glm::dvec3& p : test::lattice(15, 0.0, 0)) {
                 const glm::dvec3 from_center = p - glm::dvec3(7.0);
                 if (glm::dot(from_center, from_center) == 49.0) positions.push_back(p);
             }
             return positions;
         }},
        {"two skew lines",
         [](uint64_t s) {
             P positions;
             for (int i = 0; i < 150; ++i) {
                 positions.emplace_back(0.1 * i, 0, 0);
                 positions.emplace_back(0, 0.1 * i, s);
             }
             return positions;
         }},
        {"a plane and one apex",
         [](uint64_t s) {
             P positions = test::moved(test::lattice(6, 0.0, 0), {1, 1, 0}, {});
             positions.emplace_back(3, 3.3, 1.0 / static_cast<double>(s));
             return positions;
         }},
        {"two scales",
         [](uint64_t s) {
             return test::joined(test::random_positions(200, s, 1e-3),
                                 test::random_positions(200, s + 1, 1e3));
         }},
        {"nearly flat, turned",
         [](uint64_t s) {
             return test::turned(test::moved(test::random_positions(300, s), {1, 1, 2e-6}, {}),
                                 1.0);
         }},
    };
}

std::vector<test::ProbeFamily> all_families() {
    std::vector<test::ProbeFamily> families = test::probe_families();
    for (test::ProbeFamily& family : hard_families()) families.push_back(std::move(family));
    return families;
}

class Families : public testing::TestWithParam<size_t> {};

TEST_P(Families, AgreeWithOthers) {
    const test::ProbeFamily family = all_families()[GetParam()];
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(family.name + " " + std::to_string(seed));
        expect_agreement(merged(family.make(seed)));
    }
}

TEST(Programs, AgreeOnSubsetsOfASmallGrid) {
    EXPECT_TRUE(rc::check([](const std::set<uint8_t>& places) {
        std::vector<glm::dvec3> positions;
        for (const uint8_t place : places) {
            positions.emplace_back(place % 4, place / 4 % 4, place / 16 % 4);
        }
        expect_agreement(merged(positions));
    }));
}

TEST(Programs, AgreeOnManyProbes) {
    expect_agreement(merged(test::random_positions(30'000, 1, 100.0)));
}

TEST(Programs, AgreeOnThinNeedlesOrSayThatTetGenFailed) {
    for (const double width : {1e-8, 1e-10, 1e-12, 1e-13, 1e-14}) {
        for (uint64_t seed = 1; seed <= 10; ++seed) {
            const auto needle = test::turned(
                test::moved(test::random_positions(300, seed), {1, width, width}, {}), 1.0);
            const auto theirs = tetrahedralize_with_program(needle, 0.0, kTetgen);
            if (theirs) {
                EXPECT_EQ(*theirs, tetrahedralize(needle));
            } else {
                EXPECT_TRUE(error_text(theirs.error()).starts_with("tetralight-tetgen: "));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, Families, testing::Range<size_t>(0, all_families().size()), [](const auto& instance) {
        std::string name = all_families()[instance.param].name;
        std::ranges::replace_if(
            name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
        return name;
    });

}  // namespace
}  // namespace tetralight
