// SPDX-License-Identifier: Apache-2.0
#include <tetralight/batch/batch_report.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

using settings::Json;

BatchFile probes(double seconds, double error) {
    return {.kind = "probes",
            .name = "hall.probes",
            .bytes = 100,
            .seconds = seconds,
            .report = {{"rays", 1000},
                       {"probes", 40},
                       {"dilated", 10},
                       {"standard_error", {{"median", 0.0}, {"p99", error}}}},
            .leaks = {{"through_walls", {{"mean", 0.25}}}}};
}

BatchFile lightmaps(double seconds, const Json& errors) {
    return {.kind = "lightmaps",
            .name = "hall.lightmaps",
            .bytes = 1000,
            .seconds = seconds,
            .report = {{"rays", 500}, {"standard_error", errors}},
            .leaks = nullptr};
}

Json limits_of(const Json& report, size_t scene = 0) {
    return report["scenes"][scene]["limits"];
}

TEST(BatchReport, ComparesEachFileWithItsLimits) {
    const std::vector<BatchScene> scenes{
        {"hall",
         {{"dead_probes", 0.25}, {"error", 0.5}, {"leak", 0.2}, {"seconds", 9.0}},
         {probes(4.0, 0.5), lightmaps(6.0, {{"median", 0.75}})}}};
    const Json report = batch_report(scenes);
    EXPECT_EQ(
        limits_of(report),
        (Json{
            {{"name", "dead_probes of probes"}, {"value", 0.25}, {"limit", 0.25}, {"passed", true}},
            {{"name", "error of probes"}, {"value", 0.5}, {"limit", 0.5}, {"passed", true}},
            {{"name", "leak of probes"}, {"value", 0.25}, {"limit", 0.2}, {"passed", false}},
            {{"name", "error of lightmaps"}, {"value", 0.75}, {"limit", 0.5}, {"passed", false}},
            {{"name", "seconds"}, {"value", 10.0}, {"limit", 9.0}, {"passed", false}}}));
    EXPECT_EQ(report["passed"], false);
    EXPECT_EQ(report["scenes"][0]["rays"], 1500);
    EXPECT_EQ(report["scenes"][0]["seconds"], 10.0);
    EXPECT_EQ(failed_limits(report),
              "hall: leak of probes is 0.25, more than 0.2; "
              "hall: error of lightmaps is 0.75, more than 0.5; "
              "hall: seconds are 10, more than 9");
}

TEST(BatchReport, ValuesThatAreNotKnownDoNotPass) {
    const std::vector<BatchScene> scenes{{"hall", {{"error", 1.0}}, {lightmaps(1.0, nullptr)}}};
    const Json report = batch_report(scenes);
    EXPECT_EQ(limits_of(report)[0]["value"], Json());
    EXPECT_EQ(failed_limits(report), "hall: error of lightmaps is not known; the limit is 1");
}

TEST(BatchReport, PassesWithoutLimitsAndFailsWithAnError) {
    std::vector<BatchScene> scenes{{"hall", Json::object(), {probes(1.0, 1.0)}}};
    EXPECT_EQ(batch_report(scenes)["passed"], true);
    scenes.push_back({"yard", Json::object(), {}, "it was cancelled"});
    const Json report = batch_report(scenes);
    EXPECT_EQ(report["passed"], false);
    EXPECT_EQ(report["scenes"][0]["passed"], true);
    EXPECT_EQ(failed_limits(report), "yard: it was cancelled");
}

TEST(BatchReport, AsJunitHasATestForEachFileAndLimit) {
    const std::vector<BatchScene> scenes{{"a<b>&\"c\"\n", {{"error", 0.25}}, {probes(4.0, 0.5)}},
                                         {"yard", Json::object(), {}, "it failed"}};
    EXPECT_EQ(junit_text(batch_report(scenes)), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
  <testsuite name="a&lt;b&gt;&amp;&quot;c&quot;\u000a" tests="2" failures="1" time="4">
    <testcase classname="a&lt;b&gt;&amp;&quot;c&quot;\u000a" name="probes" time="4"/>
    <testcase classname="a&lt;b&gt;&amp;&quot;c&quot;\u000a" name="error of probes" time="0"><failure message="error of probes is 0.5, more than 0.25"/></testcase>
  </testsuite>
  <testsuite name="yard" tests="1" failures="1" time="0">
    <testcase classname="yard" name="bake" time="0"><failure message="it failed"/></testcase>
  </testsuite>
</testsuites>
)");
}

}  // namespace
}  // namespace tetralight
