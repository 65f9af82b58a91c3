// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/house_fixture.h"
#include "tests/cli/picture.h"

namespace tetralight::test {
namespace {

class CheckLeaks : public HouseFixture {
  protected:
    CheckLeaks() : HouseFixture("64") {}

    /// With few places and samples.
    static Arguments arguments(const Arguments& more = {}) {
        Arguments all{"check-leaks", "v.probes", "--scene", kCourtyard,
                      "--places",    "100",      "-s",      "16"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

TEST_F(CheckLeaks, ReportsTheSharesAsJson) {
    const Json json = run_json(arguments());
    EXPECT_EQ(json["places"], 100);
    EXPECT_GT(json["mean_light"], 0.0);
    for (const char* part : {"through_walls", "missing", "rest"}) {
        EXPECT_GE(json[part]["mean"], 0.0);
        EXPECT_GE(json[part]["p95"], 0.0);
    }
    EXPECT_GT(json["noise"], 0.0);
    EXPECT_GE(json["without_walls"]["through_walls"]["mean"], 0.0);
    EXPECT_LE(json["worst"].size(), 8u);
    EXPECT_EQ(json, run_json(arguments({"-j", "1"})));
    EXPECT_NE(json, run_json(arguments({"--seed", "1"})));
}

TEST_F(CheckLeaks, TextHasATable) {
    const std::string out = succeed(arguments()).out;
    EXPECT_EQ(out.find("v.probes: light at 100 free places, "), 0u) << out;
    EXPECT_TRUE(contains(out, "\n    through walls  ")) << out;
    EXPECT_TRUE(contains(out, "\n    noise in the rest  ")) << out;
}

TEST_F(CheckLeaks, FailsWhereMoreThanAllowedComesThroughWalls) {
    const Json json = run_json(arguments());
    ASSERT_GT(json["through_walls"]["mean"], 1e-9);
    const CommandResult result = run(arguments({"--max-leak", "1e-9", "--json"}));
    EXPECT_EQ(result.exit_code, 1);
    const Json failure = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(failure["error"]["field"], "max_leak");
    EXPECT_EQ(failure["through_walls"], json["through_walls"]);
    EXPECT_TRUE(contains(result.err, "v.probes: light through walls is "));
    succeed(arguments({"--max-leak", "100%"}));
}

TEST_F(CheckLeaks, DrawsAPicture) {
    succeed(arguments({"--picture", "leaks.png"}));
    const auto picture = decode_picture(read("leaks.png"));
    ASSERT_TRUE(picture);
    EXPECT_GT(picture->width, 400u);
    EXPECT_GT(picture->height, 100u);
    fail_and_keep("v.probes", arguments({"--picture", "none/leaks.png"}));
}

TEST_F(CheckLeaks, WarnsOfAnotherScene) {
    EXPECT_FALSE(contains(succeed(arguments()).err, "warning"));
    EXPECT_TRUE(contains(succeed(arguments({"--sky", "1,0,0"})).err,
                         "warning: v.probes: was baked from another scene, sky or sun"));
    EXPECT_TRUE(contains(fail(arguments({"--sky", "1,0,0", "--max-leak", "50%"})),
                         "v.probes: was baked from another scene, sky or sun"));
}

TEST_F(CheckLeaks, RefusesWhatItCannotCompare) {
    EXPECT_TRUE(contains(misuse(arguments({"--places", "0"})), "--places"));
    EXPECT_TRUE(contains(misuse({"check-leaks", "v.probes"}), "--scene"));
    EXPECT_TRUE(contains(fail({"check-leaks", "v.probes", "--scene", "none.glb"}),
                         "none.glb: cannot open"));
    EXPECT_TRUE(contains(fail(arguments({"--clearance", "1000"})), "is in free space"));
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    EXPECT_TRUE(contains(fail({"check-leaks", "unlit.probes", "--scene", kCourtyard}),
                         "unlit.probes: the volume holds no light"));
}

TEST_F(CheckLeaks, IsPartOfABakesReportWhenAsked) {
    const Json baked =
        run_json({"bake", kCourtyard, "-o", "b.probes", "-s", "16", "--check-leaks"});
    Json checked = run_json({"check-leaks", "b.probes", "--scene", kCourtyard});
    checked.erase("file");
    EXPECT_EQ(baked["leaks"], checked);
    EXPECT_TRUE(
        contains(misuse({"bake", kCourtyard, "-o", "b.part", "--probes", "0..5", "--check-leaks"}),
                 "--check-leaks"));
}

}  // namespace
}  // namespace tetralight::test
