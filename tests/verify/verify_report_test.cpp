// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_report.h>

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace tetralight {
namespace {

/// A probe whose volume is `difference` above a traced light of 1, both with an error of 0.6 % and
/// 0.8 %, 1 % together.
VerifyProbe probe_with(double difference) {
    VerifyProbe probe;
    probe.volume = glm::dvec3(1.0 + difference);
    probe.volume_error = glm::dvec3(0.006);
    probe.traced.mean = glm::dvec3(1.0);
    probe.traced.error = glm::dvec3(0.008);
    probe.traced.sample_count = 10;
    return probe;
}

VerifyPlace place_with(double answer, double traced) {
    VerifyPlace place;
    place.answer = glm::dvec3(answer);
    place.traced.mean = glm::dvec3(traced);
    return place;
}

TEST(VerifyReport, ZIsTheDifferenceInBothBars) {
    VerifyReport report;
    report.probes = {probe_with(0.02), probe_with(-0.04)};
    summarize(report);
    EXPECT_NEAR(report.probes[0].z.x, 2.0, 1e-4);
    EXPECT_NEAR(report.probes[1].z.y, -4.0, 1e-4);
    const VerifyChannel& blue = report.channels[2];
    EXPECT_EQ(blue.decided_count, 2u);
    EXPECT_NEAR(blue.within_3_sigma, 0.5, 1e-12);
    EXPECT_NEAR(blue.mean_z, -1.0, 1e-4);
    EXPECT_NEAR(blue.rms_z, std::sqrt((4.0 + 16.0) / 2.0), 1e-4);
    EXPECT_NEAR(blue.mean_difference, -0.01, 1e-9);
    EXPECT_EQ(report.sample_count, 20u);
}

TEST(VerifyReport, WideAndUnknownBarsAreUndecided) {
    VerifyReport report;
    report.probes = {probe_with(0.0), probe_with(0.0), probe_with(0.5)};
    report.probes[1].traced.error.x = 0.03;
    report.probes[2].volume_error = glm::dvec3(0.0);
    summarize(report);
    EXPECT_NEAR(report.channels[0].undecided, 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(report.channels[1].undecided, 1.0 / 3.0, 1e-12);
    EXPECT_EQ(report.channels[1].within_3_sigma, 1.0);
}

/// Bars of dim probes are relative to a hundredth of the mean light.
TEST(VerifyReport, DimProbesAreDecidedByTheMeanLight) {
    VerifyReport report;
    report.probes = {probe_with(0.0), probe_with(0.0)};
    report.probes[1].volume = report.probes[1].traced.mean = glm::dvec3(1e-5);
    report.probes[1].volume_error = report.probes[1].traced.error = glm::dvec3(1e-5);
    summarize(report);
    EXPECT_TRUE(report.probes[1].is_decided[0]);
}

TEST(VerifyReport, DarkProbesAgree) {
    VerifyReport report;
    report.probes = {VerifyProbe{}};
    summarize(report);
    EXPECT_EQ(report.probes[0].z, glm::dvec3(0.0));
    EXPECT_EQ(report.channels[0].within_3_sigma, 1.0);
}

/// By Parseval's theorem: a difference of 0.3 in one coefficient beside a light of 2.
TEST(VerifyReport, DirectionalDifferenceIsOverAllNormals) {
    VerifyReport report;
    report.probes = {probe_with(0.0)};
    report.probes[0].irradiance.coefficients[0] = glm::vec3(2.0f);
    report.probes[0].traced.irradiance = report.probes[0].irradiance;
    report.probes[0].irradiance.coefficients[5] = glm::vec3(0.3f);
    summarize(report);
    EXPECT_NEAR(report.directional_difference, 0.15, 1e-6);
}

TEST(VerifyReport, PlacesShowLeaksAndTheInterpolationError) {
    VerifyReport report;
    report.places = {place_with(1.0, 1.0), place_with(0.5, 0.0), place_with(0.2, 2.0),
                     place_with(1.1, 1.0)};
    report.places[1].is_unseen = true;
    report.places[3].is_outside = true;
    summarize(report);
    EXPECT_NEAR(report.mean_light, 1.0, 1e-9);
    EXPECT_TRUE(report.places[1].is_leak);
    EXPECT_TRUE(report.places[2].is_dark);
    EXPECT_NEAR(report.leak_share, 0.25, 1e-12);
    EXPECT_NEAR(report.dark_share, 0.25, 1e-12);
    EXPECT_NEAR(report.unseen_share, 0.25, 1e-12);
    EXPECT_NEAR(report.outside_share, 0.25, 1e-12);
    EXPECT_NEAR(report.interpolation.mean, (0.0 + 0.5 + 1.8 + 0.1) / 4.0, 1e-6);
}

/// Little light in the dark is not a leak, nor is noise of the referee.
TEST(VerifyReport, SmallAndNoisyDifferencesAreNotLeaks) {
    VerifyReport report;
    report.places = {place_with(2.0, 2.0), place_with(0.03, 0.0), place_with(1.0, 0.0)};
    report.places[2].traced.error = glm::dvec3(0.5);
    summarize(report);
    EXPECT_EQ(report.leak_share, 0.0);
}

TEST(VerifyReport, JsonHasAllOfIt) {
    VerifyReport report;
    report.referee = "path tracer";
    report.probes = {probe_with(0.02)};
    report.places = {place_with(1.0, 1.0)};
    report.failures = {{"min_within", "too few"}};
    summarize(report);
    const auto json = nlohmann::json::parse(verify_report_json(report));
    EXPECT_EQ(json["referee"], "path tracer");
    EXPECT_NEAR(json["channels"]["red"]["mean_z"], 2.0, 1e-4);
    EXPECT_NEAR(json["probes"][0]["volume"][0], 1.02, 1e-12);
    EXPECT_EQ(json["places"][0]["is_leak"], false);
    EXPECT_EQ(json["failures"][0]["setting"], "min_within");
}

}  // namespace
}  // namespace tetralight
