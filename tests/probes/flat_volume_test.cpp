// SPDX-License-Identifier: Apache-2.0
// Volumes whose probes lie in a plane, on a line or in one point.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

const glm::dmat4 kWorld =
    glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3)), 0.7, glm::dvec3(1, 1, 0));

glm::dvec3 in_world(const glm::dvec3& p) {
    return glm::dvec3(kWorld * glm::dvec4(p, 1.0));
}

/// Positions in [-1, 1]³, squeezed and turned.
std::vector<glm::dvec3> squeezed(size_t count, const glm::dvec3& scale, uint64_t seed) {
    std::vector<glm::dvec3> positions = test::random_positions(count, seed);
    for (glm::dvec3& p : positions) p = in_world(p * scale);
    return positions;
}

glm::vec3 light_at(const ProbeVolume& volume, const glm::dvec3& world) {
    const CellLocation location = locate(volume.view(), glm::vec3(world));
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        EXPECT_GE(location.weights[i], 0.0f);
        sum += location.weights[i];
    }
    EXPECT_NEAR(sum, 1.0f, 1e-6f);
    return interpolate(volume.view(), location).irradiance.coefficients[0];
}

void expect_sound(const ProbeVolume& volume, Dimension dimension) {
    EXPECT_EQ(volume.info.dimension, dimension);
    const auto status = verify(volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
    for (const std::string& problem : validate(volume.view()).problems()) ADD_FAILURE() << problem;
}

TEST(FlatVolume, PlaneReproducesALinearFieldAndIsConstantAcrossIt) {
    const ProbeVolume volume = test::make_lit_volume(squeezed(100, {1, 1, 0}, 1));
    expect_sound(volume, Dimension::Plane);
    for (const glm::dvec3& p : test::random_positions(300, 2, 0.6)) {
        const glm::dvec3 in_plane = in_world({p.x, p.y, 0.0});
        const glm::vec3 expected = test::linear_light(in_plane).coefficients[0];
        EXPECT_LT(glm::distance(light_at(volume, in_plane), expected), 1e-5f);
        EXPECT_LT(glm::distance(light_at(volume, in_world({p.x, p.y, 5 * p.z})), expected), 1e-5f);
    }
}

TEST(FlatVolume, PlaneIsDefinedAndContinuousBeyondItsHull) {
    const ProbeVolume volume = test::make_lit_volume(squeezed(30, {1, 1, 0}, 3));
    glm::vec3 previous = light_at(volume, in_world({4, 0, 0}));
    constexpr int kSteps = 20000;
    for (int i = 1; i <= kSteps; ++i) {
        const double angle = 6.2831853 * i / kSteps;
        const double radius = 4.0 * std::cos(3.0 * angle);  // in and out of the hull
        const glm::vec3 here =
            light_at(volume, in_world({radius * std::cos(angle), radius * std::sin(angle), 1.0}));
        ASSERT_LT(glm::distance(here, previous), 0.02f) << i;
        previous = here;
    }
    light_at(volume, in_world({1e6, -1e7, 1e3}));
}

TEST(FlatVolume, ThreeProbesAreATriangle) {
    const ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    expect_sound(volume, Dimension::Plane);
    const glm::vec3 expected = test::linear_light({0.25, 0, 0.5}).coefficients[0];
    EXPECT_LT(glm::distance(light_at(volume, {0.25, 9, 0.5}), expected), 1e-6f);
}

TEST(FlatVolume, LineInterpolatesAlongItsChainAndIsConstantBeyondItsEnds) {
    const ProbeVolume volume = test::make_lit_volume(squeezed(20, {1, 0, 0}, 4));
    expect_sound(volume, Dimension::Line);
    double low = 1.0, high = -1.0;
    for (const glm::dvec3& p : test::random_positions(20, 4)) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
    }
    for (const glm::dvec3& p : test::random_positions(300, 5, 3.0)) {
        const double on_line = std::clamp(p.x, low, high);
        const glm::vec3 expected = test::linear_light(in_world({on_line, 0, 0})).coefficients[0];
        EXPECT_LT(glm::distance(light_at(volume, in_world(p)), expected), 1e-5f);
    }
}

TEST(FlatVolume, TwoProbesAreASegment) {
    const ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {0, 4, 0}});
    expect_sound(volume, Dimension::Line);
    const glm::vec3 expected = test::linear_light({0, 1, 0}).coefficients[0];
    EXPECT_LT(glm::distance(light_at(volume, {7, 1, -7}), expected), 1e-6f);
}

TEST(FlatVolume, OneProbeIsTheSameEverywhere) {
    const ProbeVolume volume = test::make_lit_volume({{1, 2, 3}});
    expect_sound(volume, Dimension::Point);
    const glm::vec3 expected = test::linear_light({1, 2, 3}).coefficients[0];
    for (const glm::dvec3& p : test::random_positions(50, 6, 1e6)) {
        EXPECT_EQ(light_at(volume, p), expected);
    }
    EXPECT_EQ(light_at(volume, {1, 2, 3}), expected);
}

TEST(FlatVolume, NearlyFlatBehavesLikeFlat) {
    std::vector<glm::dvec3> positions = squeezed(60, {1, 1, 0}, 7);
    const ProbeVolume flat = test::make_lit_volume(positions);
    std::vector<glm::dvec3> bent = positions;
    for (size_t i = 0; i < bent.size(); ++i) bent[i] += 1e-8 * static_cast<double>(i % 7);
    const ProbeVolume nearly = test::make_lit_volume(bent);
    expect_sound(nearly, Dimension::Plane);
    for (const glm::dvec3& p : test::random_positions(200, 8, 2.0)) {
        EXPECT_LT(glm::distance(light_at(nearly, in_world(p)), light_at(flat, in_world(p))), 1e-4f);
    }
}

TEST(FlatVolume, FindsTheSameAnswerFromEveryHint) {
    for (const glm::dvec3& scale : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0)}) {
        const ProbeVolume volume = test::make_lit_volume(squeezed(25, scale, 9));
        for (const glm::dvec3& p : test::random_positions(30, 10, 2.0)) {
            const glm::vec3 world(in_world(p));
            const auto expected = interpolate(volume.view(), locate(volume.view(), world));
            for (uint32_t hint = 0; hint < volume.cells.size(); ++hint) {
                const auto result = interpolate(volume.view(), locate(volume.view(), world, hint));
                EXPECT_LT(glm::distance(result.irradiance.coefficients[0],
                                        expected.irradiance.coefficients[0]),
                          1e-5f);
            }
        }
    }
}

}  // namespace
}  // namespace tetralight
