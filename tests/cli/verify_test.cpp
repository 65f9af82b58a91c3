// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "tests/cli/house_fixture.h"
#include "tests/support/blender.h"

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

TEST_F(Verify, RefusesToCompareNothing) {
    EXPECT_TRUE(
        contains(misuse({"verify", kCourtyard, "v.probes", "--probes", "0", "--places", "0"}),
                 "probes and places are both 0"));
}

TEST_F(Verify, FailsIfTheTimeLimitEndsBeforeAnythingIsTraced) {
    const Arguments all = arguments({"--time-limit", "1e-9", "--html", "page.html"});
    const std::string error = fail_and_keep("page.html", all);
    EXPECT_TRUE(contains(error, "time limit of 1e-09 s")) << error;
    EXPECT_TRUE(contains(error, "nothing was traced")) << error;
    Arguments with_json = all;
    with_json.emplace_back("--json");
    const CommandResult result = run(with_json);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(Json::parse(result.out, nullptr, false)["error"]["field"], "time_limit");
}

TEST_F(Verify, ThePageEscapesNamesOfFiles) {
    const std::string scene = "s<b>&\".glb", volume = "v<b>&\".probes";
    std::filesystem::copy_file(kCourtyard, path(scene));
    std::filesystem::rename(path("v.probes"), path(volume));
    Arguments all = arguments({"--html", "page.html"});
    all[1] = scene;
    all[2] = volume;
    succeed(all);
    const std::string page = read("page.html");
    EXPECT_TRUE(contains(page, "s&lt;b&gt;&amp;&quot;.glb"));
    EXPECT_TRUE(contains(page, "v&lt;b&gt;&amp;&quot;.probes"));
    EXPECT_FALSE(contains(page, "<b>"));
}

TEST_F(Verify, RefusesPagesThatCannotBeWrittenAndKeepsWhatIsThere) {
    EXPECT_TRUE(contains(fail(arguments({"--html", "missing/page.html"})), "missing/page.html"));
    std::filesystem::create_directory(path("folder.html"));
    EXPECT_TRUE(contains(fail(arguments({"--html", "folder.html"})), "folder.html"));
    EXPECT_TRUE(contains(misuse(arguments({"--html", "v.probes"})), ".html"));
    std::filesystem::rename(path("v.probes"), path("v.html"));
    Arguments onto_volume = arguments({"--html", "v.html"});
    onto_volume[2] = "v.html";
    const std::string volume = read("v.html");
    EXPECT_TRUE(contains(fail(onto_volume), "v.html"));
    EXPECT_EQ(read("v.html"), volume);
}

TEST_F(Verify, NamesAnotherRefereeThatItDoesNotHave) {
    EXPECT_TRUE(contains(misuse(arguments({"--referee", "WRONG"})), "WRONG"));
    const std::string error =
        fail(arguments({"--referee", "cycles", "--blender", "/not/there/blender"}));
    EXPECT_TRUE(contains(error, "/not/there/blender")) << error;
}

TEST_F(Verify, AsksCyclesWhereBlenderIsInstalled) {
    if (!has_blender()) GTEST_SKIP() << "Blender is not installed";
    Arguments all = arguments({"--referee", "cycles", "--html", "page.html"});
    all[4] = all[6] = "1";
    const Json json = run_json(all);
    EXPECT_EQ(json["referee"].get<std::string>().rfind("Cycles ", 0), 0u);
    EXPECT_EQ(json["probes"].size(), 1u);
    EXPECT_EQ(json["places"].size(), 1u);
    EXPECT_GT(json["samples"], 0);
    EXPECT_TRUE(contains(read("page.html"), json["referee"].get<std::string>()));
}

}  // namespace
}  // namespace tetralight::test
