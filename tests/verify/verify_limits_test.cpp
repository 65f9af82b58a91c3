// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <tetralight/verify/verify_checks.h>

namespace tetralight {
namespace {

/// All figures as good as they can be.
VerifyReport good_report() {
    VerifyReport report;
    report.probes.resize(900);
    report.places.resize(100);
    for (VerifyChannel& channel : report.channels) channel.decided_count = 900;
    return report;
}

std::vector<std::string> failed_settings(const VerifyReport& report) {
    std::vector<std::string> settings;
    for (const VerifyFailure& failure : check_limits(report, {})) {
        settings.push_back(failure.setting);
    }
    return settings;
}

using Settings = std::vector<std::string>;

TEST(VerifyLimits, AGoodReportKeepsAll) {
    EXPECT_EQ(failed_settings(good_report()), Settings{});
}

TEST(VerifyLimits, EachFigureHasALimit) {
    VerifyReport report = good_report();
    report.channels[1].within_3_sigma = 0.98;
    EXPECT_EQ(failed_settings(report), Settings{"min_within"});
    report = good_report();
    report.channels[2].undecided = 0.2;
    EXPECT_EQ(failed_settings(report), Settings{"max_undecided"});
    report = good_report();
    report.leak_share = 0.06;
    EXPECT_EQ(failed_settings(report), Settings{"max_leak_share"});
    report = good_report();
    report.unseen_share = 0.06;
    EXPECT_EQ(failed_settings(report), Settings{"max_unseen_share"});
    report = good_report();
    report.interpolation.mean = 0.3;
    EXPECT_EQ(failed_settings(report), Settings{"max_interpolation"});
}

/// The mean of 900 z has a standard error of 1/30, of which three are allowed in addition to 0.1.
TEST(VerifyLimits, TheMeanDifferenceMayBeChance) {
    VerifyReport report = good_report();
    report.channels[0].mean_z = -0.19;
    EXPECT_EQ(failed_settings(report), Settings{});
    report.channels[0].mean_z = -0.21;
    EXPECT_EQ(failed_settings(report), Settings{"max_mean_z"});
}

TEST(VerifyLimits, MessagesNameTheChannelAndTheValues) {
    VerifyReport report = good_report();
    report.channels[1].within_3_sigma = 0.5;
    const auto failures = check_limits(report, {});
    ASSERT_EQ(failures.size(), 1u);
    EXPECT_EQ(failures[0].message,
              "green mean irradiance: 50.00 % of 900 probes are within 3 standard errors, fewer "
              "than 99.00 %");
}

}  // namespace
}  // namespace tetralight
