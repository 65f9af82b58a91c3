// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/house_fixture.h"

namespace tetralight::test {
namespace {

class Verify : public HouseFixture {
  protected:
    Verify() : HouseFixture("1024") {}

    /// With few probes, places and paths, and limits that all volumes keep.
    static Arguments arguments(const Arguments& more = {}) {
        Arguments all{"verify", kCourtyard,         "v.probes", "--probes",
                      "20",     "--places",         "20",       "-s",
                      "4096",   "--max-undecided",  "1",        "--max-unseen-share",
                      "1",      "--max-leak-share", "1",        "--min-within",
                      "0"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

TEST_F(Verify, ReportsFiguresProbesAndPlacesAsJson) {
    const Json json = run_json(arguments());
    EXPECT_EQ(json["file"], "v.probes");
    EXPECT_EQ(json["referee"], "path tracer");
    EXPECT_EQ(json["probes"].size(), 20u);
    EXPECT_EQ(json["places"].size(), 20u);
    EXPECT_EQ(json["samples"], 40 * 4096);
    for (const char* channel : {"red", "green", "blue"}) {
        EXPECT_LE(json["channels"][channel]["undecided"], 1.0);
    }
    EXPECT_TRUE(json["failures"].empty());
    EXPECT_EQ(json, run_json(arguments({"-j", "1"})));
    EXPECT_NE(json, run_json(arguments({"--seed", "1"})));
}

TEST_F(Verify, TextHasATableAndSaysWhatIsShared) {
    const std::string out = succeed(arguments()).out;
    EXPECT_EQ(out.find("v.probes: by the path tracer, all bounces, "), 0u) << out;
    EXPECT_TRUE(contains(out, "\n    green  ")) << out;
    EXPECT_TRUE(contains(out, "The referee shares with the baker the scene")) << out;
}

TEST_F(Verify, FailsWithTheReasonAndTheReport) {
    const CommandResult result = run(arguments({"--max-interpolation", "1e-9", "--json"}));
    EXPECT_EQ(result.exit_code, 1);
    const Json failure = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(failure["error"]["field"], "max_interpolation");
    EXPECT_EQ(failure["failures"][0]["setting"], "max_interpolation");
    EXPECT_EQ(failure["probes"].size(), 20u);
    EXPECT_TRUE(contains(result.err, "v.probes: ")) << result.err;
}

TEST_F(Verify, RefusesWhatItCannotCompare) {
    EXPECT_TRUE(contains(misuse({"verify", "v.probes"}), "VOLUME"));
    EXPECT_TRUE(contains(fail(arguments({"--sky", "3"})), "was baked from another scene"));
    EXPECT_TRUE(contains(misuse(arguments({"--target-error", "0.01"})), "--samples"));
    succeed({"tetrahedralize", "few.json", "-o", "unlit.probes"});
    EXPECT_TRUE(contains(fail({"verify", kCourtyard, "unlit.probes"}), "holds no light"));
}

}  // namespace
}  // namespace tetralight::test
