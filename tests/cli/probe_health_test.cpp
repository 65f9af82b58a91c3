// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// Bakes the courtyard with three more probes: deep in the ground, just in it, and above it.
class ProbeHealth : public CommandFixture {
  protected:
    ProbeHealth() {
        write("ground.json", R"({"groups": [{"name": "ground", "positions":
            [[2, -0.3, 6], [2, -0.02, 8], [2, 1, 7]]}]})");
    }

    [[nodiscard]] Json bake(const Arguments& more) const {
        Arguments arguments{"bake", kCourtyard, "-g", "ground.json", "-o", "v.probes", "-s", "64"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_json(arguments);
    }

    /// The group's probes as `info --probes` lists them.
    [[nodiscard]] std::vector<Json> ground_probes() const {
        std::vector<Json> probes;
        const Json info = run_json({"info", "v.probes", "--probes"});
        for (const Json& probe : info["probe_list"]) {
            if (probe["groups"] == Json::array({"ground"})) probes.push_back(probe);
        }
        std::ranges::sort(probes, {}, [](const Json& p) { return p["position"][1].get<double>(); });
        return probes;
    }
};

TEST_F(ProbeHealth, ProbesInGeometryAreMovedOrLeftOut) {
    const Json report = bake({"--virtual-offset", "0.1"});  // 0.14 of the 1.4 to the next
    EXPECT_EQ(report["moved"], 1);
    EXPECT_EQ(report["left_out"], 1);
    EXPECT_EQ(report["probes"], 255 + 2);
    const auto probes = ground_probes();
    ASSERT_EQ(probes.size(), 2u);
    EXPECT_EQ(probes[0]["position"], (Json{2.0, -0.02, 8.0}));  // where it was
    EXPECT_EQ(probes[0]["flags"], Json::array({"moved"}));
    EXPECT_GT(probes[0]["capture_offset"][1], 0.02);
    EXPECT_NEAR(probes[0]["surface_distance"], 0.02, 1e-5);
    EXPECT_EQ(probes[1]["flags"], Json::array());
    EXPECT_EQ(probes[1]["validity"], 1.0);
    EXPECT_EQ(probes[1]["capture_offset"], (Json{0.0, 0.0, 0.0}));
    const Json left_out = run_json({"info", "v.probes", "--probes"})["left_out_list"];
    EXPECT_EQ(left_out, Json::array({Json{{"group", "ground"}, {"index", 0}}}));
}

TEST_F(ProbeHealth, InfoCountsWhatWasLeftOut) {
    (void)bake({"--virtual-offset", "0.1"});
    const std::string out = succeed({"info", "v.probes"}).out;
    EXPECT_TRUE(contains(out, "257 (0 welded, 1 left out), in 6 groups")) << out;
    EXPECT_TRUE(contains(out, "1 left out\n")) << out;
    EXPECT_EQ(run_json({"info", "v.probes"})["left_out"], 1);
    succeed({"validate", "v.probes"});
}

TEST_F(ProbeHealth, BakeNamesTheGroupOfProbesInGeometry) {
    const CommandResult result = succeed({"bake", kCourtyard, "-g", "ground.json", "-o", "v.probes",
                                          "-s", "64", "--virtual-offset", "0.1"});
    EXPECT_TRUE(
        contains(result.err, "ground.json: group \"ground\": 1 of 3 probes lie inside geometry"));
    EXPECT_TRUE(contains(result.out, "(0 welded, 1 lattice, 1 moved, 1 left out)")) << result.out;
}

TEST_F(ProbeHealth, InvalidProbesCanStayDarkOrTakeTheLightOfOthers) {
    EXPECT_EQ(bake({"--virtual-offset", "0", "--invalid-probes", "keep"})["probes"], 255 + 3);
    EXPECT_EQ(ground_probes()[0]["flags"][0], "buried");
    EXPECT_EQ(bake({"--virtual-offset", "0", "--invalid-probes", "dilate"})["dilated"], 2);
    EXPECT_EQ(ground_probes()[0]["flags"], Json::array({"buried", "dilated"}));
    EXPECT_GT(ground_probes()[0]["mean_irradiance"][0], 0.0);
}

TEST_F(ProbeHealth, MinValiditySaysWhatLiesInGeometry) {
    // Above the ground nothing but fronts is seen, below it nothing but backs.
    EXPECT_EQ(bake({"--virtual-offset", "0", "--min-validity", "0"})["left_out"], 0);
    EXPECT_EQ(run_json({"info", "v.probes"})["made_with"]["min_validity"], 0.0);
}

TEST_F(ProbeHealth, OptionsAreChecked) {
    for (const Arguments& bad :
         {Arguments{"--virtual-offset", "-1"}, Arguments{"--virtual-offset", "nan"},
          Arguments{"--min-validity", "1.5"}, Arguments{"--invalid-probes", "drop"}}) {
        const std::string message = misuse({"bake", kCourtyard, "-o", "v.probes", bad[0], bad[1]});
        EXPECT_TRUE(contains(message, bad[0])) << message;
    }
}

TEST_F(ProbeHealth, TheTableHasALineForEachProbe) {
    bake_courtyard("v.probes");
    const std::string plain = succeed({"info", "v.probes"}).out;
    const std::string out = succeed({"info", "v.probes", "--probes"}).out;
    const std::string table = out.substr(plain.size());
    EXPECT_EQ(out.substr(0, plain.size()), plain);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 1 + 255);
    EXPECT_TRUE(contains(table, "validity")) << table;
}

TEST_F(ProbeHealth, TheTableOfAVolumeWithoutLightSaysNothingOfHealth) {
    succeed({"tetrahedralize", kCourtyard, "-o", "v.probes"});
    const Json probe = run_json({"info", "v.probes", "--probes"})["probe_list"][0];
    for (const char* key :
         {"validity", "standard_error", "surface_distance", "capture_offset", "mean_irradiance"}) {
        EXPECT_TRUE(probe[key].is_null()) << key;
    }
}

TEST_F(ProbeHealth, PicturesShowItInColors) {
    bake_courtyard("v.probes");
    const auto picture = [&](const Arguments& more) {
        Arguments arguments{"render", kCourtyard, "v.probes", "-o",     "p.png",  "--width",
                            "64",     "--height", "36",       "--show", "probes", "--ball-radius",
                            "0.5"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
        return read("p.png");
    };
    const std::string light = picture({}), validity = picture({"--probe-color", "validity"});
    EXPECT_TRUE(light != validity);
    EXPECT_TRUE(light == picture({"--probe-color", "light"}));
    EXPECT_TRUE(validity != picture({"--probe-color", "error"}));
    EXPECT_TRUE(contains(
        misuse({"render", kCourtyard, "v.probes", "-o", "p.png", "--probe-color", "validity"}),
        "--show"));
}

}  // namespace
}  // namespace tetralight::test
