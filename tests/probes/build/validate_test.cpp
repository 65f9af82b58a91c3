// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/validate.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(Validate, MeasuresTheVolumeOfTheHull) {
    std::vector<glm::dvec3> box = test::random_positions(50, 1, 0.5);
    for (int i = 0; i < 8; ++i) box.emplace_back(i & 1 ? 3 : -1, i & 2 ? 1 : -1, i & 4 ? 2 : -1);
    const ProbeVolume volume = test::make_lit_volume(box);
    const ValidationReport report = validate(volume.view());
    EXPECT_NEAR(report.hull_measure, 4.0 * 2.0 * 3.0, 1e-12);
    EXPECT_NEAR(report.cell_measure, 4.0 * 2.0 * 3.0, 1e-12);
    EXPECT_TRUE(report.problems().empty());
}

TEST(Validate, TakesAThinHullForWhole) {
    // Clusters of two scales, 1e5 m apart: rounding of the large products is seen in the sum.
    auto positions = test::random_positions(10, 1, 1e-3);
    for (const glm::dvec3& p : test::random_positions(10, 2)) positions.push_back(p + 1e5);
    const ValidationReport report = validate(test::make_lit_volume(positions).view());
    EXPECT_TRUE(report.problems().empty()) << report.problems()[0];
    EXPECT_LT(report.measure_rounding, 0.01 * report.hull_measure);
}

TEST(Validate, SeesAProbeThatWasMovedIntoACircumsphere) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 2));
    volume.exact_positions[20] = volume.exact_positions[21] * 0.99;
    const ValidationReport report = validate(volume.view());
    EXPECT_GT(report.inverted_cells + report.non_delaunay_faces, 0u);
    EXPECT_EQ(report.misplaced_float_probes, 1u);
}

TEST(Validate, SeesATurnedTetrahedron) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 3));
    std::swap(volume.cells[5].vertices[0], volume.cells[5].vertices[1]);
    std::swap(volume.cells[5].neighbors[0], volume.cells[5].neighbors[1]);
    EXPECT_EQ(validate(volume.view()).inverted_cells, 1u);
}

TEST(Validate, SeesALostProbe) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 4));
    volume.positions.emplace_back(0.0f);
    volume.exact_positions.emplace_back(0.0);
    const ValidationReport report = validate(volume.view());
    EXPECT_EQ(report.probes_without_cell, 1u);
    EXPECT_EQ(report.probes_without_source, 1u);
}

TEST(Validate, SeesTwoTetrahedraThatShouldHaveBeenThree) {
    // Two apexes near each other over a wide triangle: the flat pair is not Delaunay. Built by
    // moving the apexes of a pair that was.
    const std::vector<glm::dvec3> p{{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 2}, {0, 0, -2}};
    ProbeVolume volume = test::make_lit_volume(p);
    ASSERT_EQ(volume.info.inner_cell_count, 2u);
    for (size_t i = 0; i < 5; ++i) {
        volume.exact_positions[i].z *= 0.1;
        volume.positions[i] = glm::vec3(volume.exact_positions[i]);
    }
    EXPECT_EQ(validate(volume.view()).non_delaunay_faces, 1u);
}

}  // namespace
}  // namespace tetralight
