// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/light_difference.h>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/locate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// The corners of [0, 2]³.
std::vector<glm::dvec3> cube() {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(2 * (i & 1), i & 2, (i & 4) / 2);
    return corners;
}

TEST(RandomPlaces, AreInInnerCellsAndEvenlySpread) {
    const ProbeVolume volume = test::make_lit_volume(cube());
    const auto places = random_places(volume.view(), 4000);
    ASSERT_EQ(places.size(), 4000u);
    glm::dvec3 mean(0.0);
    int low = 0;
    for (const glm::dvec3& place : places) {
        EXPECT_TRUE(contains(Box<glm::dvec3>{glm::dvec3(0.0), glm::dvec3(2.0)}, place));
        mean += place / 4000.0;
        low += all(lessThan(place, glm::dvec3(1.0))) ? 1 : 0;
    }
    // The standard error of a mean is 2 / sqrt(12 * 4000) = 0.009; of an eighth it is 21 of 500.
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 1.0, 0.05);
    EXPECT_NEAR(low, 500, 105);
}

TEST(RandomPlaces, StayInTheBox) {
    const ProbeVolume volume = test::make_lit_volume(cube());
    const Box<glm::dvec3> box{glm::dvec3(1.5), glm::dvec3(9.0)};
    const auto places = random_places(volume.view(), 100, box);
    ASSERT_EQ(places.size(), 100u);
    for (const glm::dvec3& place : places) EXPECT_TRUE(contains(box, place));
    EXPECT_TRUE(random_places(volume.view(), 100, Box<glm::dvec3>{glm::dvec3(5.0), glm::dvec3(6.0)})
                    .empty());
}

TEST(RandomPlaces, OfPlanesAndLinesLieInThem) {
    const ProbeVolume plane = test::make_lit_volume({{0, 1, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}});
    for (const glm::dvec3& place : random_places(plane.view(), 50)) EXPECT_DOUBLE_EQ(place.y, 1.0);
    const ProbeVolume line = test::make_lit_volume({{0, 0, 3}, {1, 0, 3}, {5, 0, 3}});
    EXPECT_EQ(random_places(line.view(), 50).size(), 50u);
    EXPECT_TRUE(random_places(ProbeVolume{}.view(), 50).empty());
}

TEST(LightDifference, IsZeroForTheVolumeItself) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 3));
    const auto places = random_places(volume.view(), 200);
    const LightDifference difference =
        measure_difference(volume.view(), places, [&](const glm::dvec3& position) {
            return light_at(volume.view(), position, Walls::HideProbes);
        });
    EXPECT_EQ(difference.place_count, 200u);
    EXPECT_EQ(difference.from_light, DifferenceQuantiles{});
    EXPECT_EQ(difference.without_walls, DifferenceQuantiles{});
}

/// Constant light of irradiance 2, of which a target shows a fourth less at one place in ten.
TEST(LightDifference, IsRelativeToTheLargestIrradiance) {
    ProbeVolume volume = test::make_lit_volume(cube());
    const IrradianceSh light =
        irradiance_from_radiance(constant_radiance(glm::vec3(2.0f / 3.14159265f)));
    for (IrradianceSh& probe : volume.irradiance) probe = light;
    EXPECT_NEAR(largest_irradiance(volume.view()), 2.0, 1e-5);
    int calls = 0;
    const LightDifference difference = measure_difference(
        volume.view(), random_places(volume.view(), 100),
        [&](const glm::dvec3&) { return ++calls % 10 == 0 ? light * 0.75f : light; });
    EXPECT_NEAR(difference.from_light.median, 0.0, 1e-6);
    EXPECT_NEAR(difference.from_light.p99, 0.25, 1e-5);
    EXPECT_NEAR(difference.from_light.worst, 0.25, 1e-5);
}

/// A target that shows light by normals: that of the volume, but black from below.
TEST(LightDifference, ComparesIrradianceByNormals) {
    ProbeVolume volume = test::make_lit_volume(cube());
    const IrradianceSh light = irradiance_from_radiance(constant_radiance(glm::vec3(1.0f)));
    for (IrradianceSh& probe : volume.irradiance) probe = light;
    const auto shown = [&](float below) {
        return measure_difference(volume.view(), random_places(volume.view(), 10),
                                  [&](const glm::dvec3&) -> IrradianceByNormal {
                                      return [=](const glm::vec3& normal) {
                                          return evaluate_irradiance(light, normal) *
                                                 (normal.y < 0.0f ? below : 1.0f);
                                      };
                                  });
    };
    EXPECT_NEAR(shown(1.0f).from_light.worst, 0.0, 1e-6);
    EXPECT_NEAR(shown(0.0f).from_light.median, 1.0, 1e-6);
}

TEST(LightDifference, CountsVolumesThatHoldHalfFloatsAlone) {
    ProbeVolume volume = test::make_lit_volume(cube());
    const double largest = largest_irradiance(volume.view());
    make_compact_probes(volume);
    volume.irradiance.clear();
    EXPECT_NEAR(largest_irradiance(volume.view()), largest, 1e-3 * largest);
}

TEST(LightDifference, OfAVolumeWithoutLightIsZero) {
    ProbeVolume volume = test::make_lit_volume(cube());
    volume.irradiance.clear();
    const LightDifference difference =
        measure_difference(volume.view(), random_places(volume.view(), 10),
                           [](const glm::dvec3&) { return IrradianceSh{}; });
    EXPECT_EQ(difference.from_light, DifferenceQuantiles{});
}

}  // namespace
}  // namespace tetralight
