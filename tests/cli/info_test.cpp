// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Info : public CommandFixture {};

TEST_F(Info, ListsTheGroupsWithTheirProbes) {
    bake_courtyard("v.probes");
    const Json info = run_json({"info", "v.probes"});
    int probes = 0;
    std::vector<std::string> names;
    for (const Json& group : info["group_list"]) {
        names.push_back(group["name"]);
        probes += group["probes"].get<int>();
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"court", "interior", "pergola", "sky", "walls_outside"}));
    EXPECT_EQ(probes, info["probes"]);
}

TEST_F(Info, SaysHowTheVolumeWasMade) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "-b", "2", "--seed", "7"});
    const Json made_with = run_json({"info", "v.probes"})["made_with"];
    EXPECT_EQ(made_with["samples"], 16);
    EXPECT_EQ(made_with["bounces"], 2);
    EXPECT_EQ(made_with["seed"], 7);
}

TEST_F(Info, SaysTheBoundsInWorldSpace) {
    write("far.json", R"({"groups": [{"name": "far", "positions": [[1000000, 0, 0],
        [1000004, 0, 0], [1000000, 2, 0], [1000000, 0, 8]]}]})");
    succeed({"tetrahedralize", "far.json", "-o", "far.probes"});
    const Json bounds = run_json({"info", "far.probes"})["bounds"];
    EXPECT_EQ(bounds["min"], (Json{1000000.0, 0.0, 0.0}));
    EXPECT_EQ(bounds["max"], (Json{1000004.0, 2.0, 8.0}));
}

TEST_F(Info, TellsWhetherTheVolumeHoldsLight) {
    write("five.json", kFiveProbes);
    bake_courtyard("baked.probes");
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    EXPECT_EQ(run_json({"info", "baked.probes"})["is_baked"], true);
    EXPECT_EQ(run_json({"info", "unlit.probes"})["is_baked"], false);
}

TEST_F(Info, TextIsTheJsonIndented) {
    bake_courtyard("v.probes");
    const Json text = Json::parse(succeed({"info", "v.probes"}).out, nullptr, false);
    EXPECT_EQ(text, run_json({"info", "v.probes"}));
}

TEST_F(Info, RefusesBadVolumes) {
    bake_courtyard("sound.probes");
    refuse_each(bad_volumes(read("sound.probes")), "", [](const std::string& name) {
        return Arguments{"info", name};
    });
}

TEST_F(Info, NamesAVolumeThatIsNotThere) {
    EXPECT_TRUE(contains(fail({"info", "none.probes"}), "none.probes: cannot open"));
    EXPECT_TRUE(contains(fail({"info", "."}), ".: is not a regular file"));
}

TEST_F(Info, TakesAPathThatIsNotUtf8) {
    bake_courtyard("\xff.probes");
    EXPECT_EQ(run_json({"info", "\xff.probes"})["file"], "\xef\xbf\xbd.probes");
}

}  // namespace
}  // namespace tetralight::test
