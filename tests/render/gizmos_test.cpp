// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gizmos.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// A tetrahedron with its middle at (1, 1, 1).
ProbeVolume one_cell() {
    return test::make_lit_volume({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}});
}

Gizmos select(const ProbeVolume& volume, const glm::dvec3& place) {
    GizmoSettings settings;
    settings.selection = place;
    return make_gizmos(volume.view(), {}, settings);
}

TEST(Gizmos, WithoutAnythingToShowThereAreNone) {
    const Gizmos gizmos = make_gizmos(one_cell().view(), {}, {});
    EXPECT_TRUE(gizmos.balls.empty() && gizmos.lines.empty() && gizmos.labels.empty());
}

TEST(Gizmos, SelectionShowsItsCellItsProbesAndTheLightTheyGive) {
    const ProbeVolume volume = one_cell();
    const glm::dvec3 place(0.5, 1.0, 1.5);
    const Gizmos gizmos = select(volume, place);
    ASSERT_EQ(gizmos.lines.size(), 2u);
    EXPECT_EQ(gizmos.lines[0].lines.size(), 6u);
    EXPECT_EQ(gizmos.lines[1].lines.size(), 4u);
    ASSERT_EQ(gizmos.balls.size(), 5u);
    EXPECT_EQ(gizmos.balls[4].center, place);
    EXPECT_NEAR(gizmos.balls[4].light.coefficients[0].x, 0.3 + 0.5 - 0.5, 1e-5);  // linear_light
}

TEST(Gizmos, LabelsAreTheWeightsOfTheProbes) {
    // Barycentric weights in this tetrahedron are x/4, y/4, z/4, and 1 minus those at the origin.
    const Gizmos gizmos = select(one_cell(), {0.4, 0.8, 1.2});
    ASSERT_EQ(gizmos.labels.size(), 4u);
    for (const GizmoLabel& label : gizmos.labels) {
        const double distance = glm::length(label.position);
        const std::string expected = distance < 1.0           ? "0.40"
                                     : label.position.x > 1.0 ? "0.10"
                                     : label.position.y > 1.0 ? "0.20"
                                                              : "0.30";
        EXPECT_EQ(label.text, expected);
    }
}

TEST(Gizmos, SelectionOutsideTheHullShowsAHullCellWithItsRays) {
    const Gizmos gizmos = select(one_cell(), {5, 5, 5});
    EXPECT_EQ(gizmos.lines[0].lines.size(), 3u + 3u);
    EXPECT_EQ(gizmos.labels.size(), 3u);
}

TEST(Gizmos, SelectionInAVolumeWithoutProbesIsTheAmbientLight) {
    ProbeVolume volume;
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(2.0f)));
    const Gizmos gizmos = select(volume, {0, 0, 0});
    ASSERT_EQ(gizmos.balls.size(), 1u);
    EXPECT_EQ(gizmos.balls[0].light, volume.info.ambient);
}

TEST(Gizmos, UnlitProbesShowTheAmbientLight) {
    ProbeVolume volume = one_cell();
    volume.irradiance.clear();
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(2.0f)));
    GizmoSettings settings;
    settings.has_probes = true;
    const Gizmos gizmos = make_gizmos(volume.view(), {}, settings);
    ASSERT_EQ(gizmos.balls.size(), 4u);
    EXPECT_EQ(gizmos.balls[0].light, volume.info.ambient);
    // Edges of 4 and √32 metres, three of each: the median is one of them.
    EXPECT_NEAR(gizmos.balls[0].radius, 0.1 * std::sqrt(32.0), 1e-5);
}

TEST(Gizmos, ProxyVolumesShowTheirPoints) {
    const ProbeVolume volume = one_cell();
    LppvSettings grid_settings;
    grid_settings.resolution_mode = LppvResolution::Custom;
    grid_settings.resolution = {2, 3, 4};
    const LppvPart part{glm::dmat4(1.0), glm::dvec3(0.0), glm::dvec3(1.0)};
    const auto grid = make_lppv_grid({glm::dmat4(1.0), std::span(&part, 1)}, grid_settings);
    ASSERT_TRUE(grid);
    const auto lppv = make_lppv(volume.view(), *grid, {});
    ASSERT_TRUE(lppv);
    GizmoSettings settings;
    settings.has_proxies = true;
    const Gizmos gizmos = make_gizmos(volume.view(), std::span(&*lppv, 1), settings);
    ASSERT_EQ(gizmos.balls.size(), 24u);
    EXPECT_EQ(gizmos.balls[23].center, glm::dvec3(1.0));
    EXPECT_EQ(gizmos.balls[0].light, lppv->irradiance[0]);
}

}  // namespace
}  // namespace tetralight
