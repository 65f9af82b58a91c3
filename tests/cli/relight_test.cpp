// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Relight : public CommandFixture {
  protected:
    Relight() {
        write("empty.gltf", kEmptyScene);
        write("five.json", kFiveProbes);
    }

    /// Five probes under a grey sky and a baked sun from above, in layers.
    void bake(const std::string& layers, const Arguments& more = {},
              const std::string& output = "v.probes") const {
        Arguments arguments{"bake",
                            "empty.gltf",
                            "-g",
                            "five.json",
                            "-o",
                            output,
                            "-s",
                            "1024",
                            "--sky",
                            "1",
                            "--sun-direction",
                            "0,-1,0",
                            "--sun-irradiance",
                            "2,2,2",
                            "--sun-mode",
                            "baked"};
        if (!layers.empty()) arguments.insert(arguments.end(), {"--layers", layers});
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
    }

    /// Irradiance coefficients (red) at (1, 1, 1).
    [[nodiscard]] std::vector<double> light_of(const std::string& volume) const {
        const std::string out = succeed({"query", volume, "--json"}, "1 1 1").out;
        const Json answer = Json::parse(out);
        std::vector<double> red;
        for (const Json& coefficient : answer["irradiance_sh"]) red.push_back(coefficient[0]);
        return red;
    }

    /// Coefficient 0 of a sky of radiance 1, and of a sun of 2 with the sky's.
    static constexpr double kSky = 11.136656;        // π · 4π · 0.2820948
    static constexpr double kSun = 2.0 * 0.8862269;  // 2 · π · 0.2820948
};

TEST_F(Relight, WeightsDimLayers) {
    bake("sun,sky");
    EXPECT_NEAR(light_of("v.probes")[0], kSky + kSun, 0.01);
    succeed({"relight", "v.probes", "--weights", "sun=0,sky=0.5", "-o", "dim.probes"});
    EXPECT_NEAR(light_of("dim.probes")[0], 0.5 * kSky, 0.01);
    succeed({"relight", "dim.probes", "--weights", "sky=1", "-o", "sky.probes"});
    EXPECT_NEAR(light_of("sky.probes")[0], kSky, 0.01);
    succeed({"relight", "sky.probes", "--weights", "sun=1", "-o", "again.probes"});
    EXPECT_EQ(read("again.probes"), read("v.probes"));
}

TEST_F(Relight, JsonSaysTheWeights) {
    bake("sun,sky");
    const Json json = run_json({"relight", "v.probes", "--weights", "sun=2", "-o", "w.probes"});
    EXPECT_EQ(json["layers"], Json::parse(R"([{"name": "sun", "weight": 2.0},
                                              {"name": "sky", "weight": 1.0}])"));
    const Json info = run_json({"info", "w.probes"});
    ASSERT_EQ(info["layers"].size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(info["layers"][i]["name"], json["layers"][i]["name"]);
        EXPECT_EQ(info["layers"][i]["weight"], json["layers"][i]["weight"]);
    }
    EXPECT_EQ(info["has_transfer"], false);
}

TEST_F(Relight, InfoShowsTheNoiseOfWhatRemains) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "--layers", "sun,sky,emission", "-s", "256"});
    const Json baked = run_json({"info", "v.probes"});
    const Json& emission = baked["layers"][2]["standard_error"];
    EXPECT_GT(emission["median"], baked["standard_error"]["median"]);
    succeed({"relight", "v.probes", "--weights", "sun=0,sky=0", "-o", "night.probes"});
    const Json night = run_json({"info", "night.probes"});
    EXPECT_EQ(night["layers"][2]["standard_error"], emission);
    EXPECT_GE(night["standard_error"]["median"], emission["median"]);
    EXPECT_TRUE(contains(succeed({"info", "night.probes"}).out, "    emission  median "));
}

TEST_F(Relight, AnotherSkyTakesThePlaceOfThatOfTheBake) {
    bake("sun,transfer");
    succeed({"relight", "v.probes", "--sky", "3,2,1", "-o", "w.probes"});
    EXPECT_NEAR(light_of("w.probes")[0], 3.0 * kSky + kSun, 0.05);
    succeed({"relight", "w.probes", "--sky-intensity", "0.5", "--sky-rotation", "90", "-o",
             "x.probes"});
    EXPECT_NEAR(light_of("x.probes")[0], 1.5 * kSky + kSun, 0.05);
}

TEST_F(Relight, RangesOfSplitBakesMergeToTheBytesOfOne) {
    const Arguments more{"--mixed-lighting", "shadowmask", "-s", "64"};
    const auto bake_range = [&](const std::string& output, const Arguments& range) {
        Arguments arguments{"bake", kCourtyard, "-o",
                            output, "--layers", "sun,transfer,material:emissive_warm"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), range.begin(), range.end());
        succeed(arguments);
    };
    bake_range("whole.probes", {});
    bake_range("a.part", {"--probes", "0..100"});
    bake_range("b.part", {"--probes", "100.."});
    succeed({"merge", "b.part", "a.part", "-o", "merged.probes"});
    EXPECT_EQ(read("merged.probes"), read("whole.probes"));
}

TEST_F(Relight, AMovedSunShinesFromItsNewSide) {
    bake("sun,transfer");
    succeed({"relight", "v.probes", "--sun-direction", "-1,0,0", "--weights", "sky=0", "-o",
             "w.probes"});
    const std::vector<double> light = light_of("w.probes");
    EXPECT_NEAR(light[0], kSun, 0.01);
    EXPECT_NEAR(light[3], 2.0 * 2.0943951 * 0.48860251, 0.02);  // from +X
    EXPECT_NEAR(light[1], 0.0, 0.02);
    succeed({"relight", "v.probes", "--sun-direction", "-1,0,0", "--sun-irradiance", "4,4,4",
             "--weights", "sky=0", "-o", "w.probes"});
    EXPECT_NEAR(light_of("w.probes")[0], 2.0 * kSun, 0.02);
}

TEST_F(Relight, BlendsTwoScenarios) {
    bake("sun,sky");
    succeed({"relight", "v.probes", "--weights", "sky=0", "-o", "night.probes"});
    succeed({"relight", "v.probes", "--blend", "night.probes", "--blend-share", "0.75", "-o",
             "dusk.probes"});
    EXPECT_NEAR(light_of("dusk.probes")[0], 0.25 * kSky + kSun, 0.01);
    succeed({"validate", "dusk.probes"});
}

TEST_F(Relight, ALayerThatIsNotThereIsAnErrorThatListsThoseThatAre) {
    bake("sun,sky");
    write("out.probes", "old");
    EXPECT_EQ(fail_and_keep("out.probes",
                            {"relight", "v.probes", "--weights", "lamp=0", "-o", "out.probes"}),
              "tetralight: v.probes: there is no layer \"lamp\"; it holds \"sun\", \"sky\"\n");
}

TEST_F(Relight, RefusesWeightsThatAreNegativeOrNoNumbers) {
    bake("sun,sky");
    const auto error = [&](const std::string& weight) {
        return fail({"relight", "v.probes", "--weights", weight, "-o", "out.probes"});
    };
    EXPECT_EQ(error("sun=-1"), "tetralight: v.probes: layer \"sun\": weight -1 is negative\n");
    EXPECT_EQ(error("sun=nan"),
              "tetralight: v.probes: layer \"sun\": weight nan is not a number\n");
    EXPECT_EQ(error("sun=inf"), "tetralight: v.probes: layer \"sun\": weight inf is not finite\n");
    EXPECT_EQ(error("sun=1e39"), "tetralight: v.probes: layer \"sun\": weight inf is not finite\n");
    EXPECT_TRUE(contains(
        misuse({"relight", "v.probes", "--weights", "sun=1, sun=2", "-o", "out.probes"}),
        "--weights: layer \"sun\" is given two weights (see tetralight relight --help)\n"));
    for (const char* wrong : {"sun", "=1", "sun=", "sun=1x"}) {
        EXPECT_TRUE(contains(misuse({"relight", "v.probes", "--weights", wrong, "-o", "o.probes"}),
                             "is not of the form LAYER=WEIGHT"))
            << wrong;
    }
}

TEST_F(Relight, TheVolumeSaysWhatWasChanged) {
    bake("sun,transfer");
    succeed({"relight", "v.probes", "--sky", "2", "--sun-direction", "1,-1,0", "-o", "a.probes"});
    succeed({"relight", "a.probes", "--sky-rotation", "90", "-o", "b.probes"});
    EXPECT_EQ(run_json({"info", "b.probes"})["made_with"]["relit"],
              "--sky 2 --sun-direction 1,-1,0 --sky-rotation 90");
    EXPECT_FALSE(run_json({"info", "v.probes"})["made_with"].contains("relit"));
}

TEST_F(Relight, PartsOfABakeHaveToBeMergedFirst) {
    bake("sun", {"--probes", "0..2"}, "v.part");
    EXPECT_EQ(fail({"relight", "v.part", "--weights", "sun=0", "-o", "out.probes"}),
              "tetralight: v.part: is a part of a bake; merge its parts first\n");
}

TEST_F(Relight, OldVolumesSayThatTheyHoldNoLayers) {
    bake("");
    const std::string error =
        fail({"relight", "v.probes", "--weights", "sun=0", "-o", "out.probes"});
    EXPECT_EQ(error, "tetralight: v.probes: there is no layer \"sun\"; it holds no layers\n");
    EXPECT_TRUE(contains(fail({"relight", "v.probes", "--sky", "1", "-o", "out.probes"}),
                         "the volume holds no transfer of distant light"));
    EXPECT_TRUE(contains(succeed({"info", "v.probes"}).out, "none (light cannot change"));
    EXPECT_EQ(run_json({"info", "v.probes"})["layers"], Json::array());
}

// --- What a bake says of light -------------------------------------------------------------------

TEST_F(Relight, ExplainPrintsTheTableAndBakesNothing) {
    const Json json = run_json({"bake", "empty.gltf", "--sky", "1", "--sun-direction", "0,-1,0",
                                "--sun-irradiance", "2,2,2", "--mixed-lighting", "shadowmask",
                                "--layers", "sun", "--explain"});
    EXPECT_EQ(json["mixed_lighting"], "shadowmask");
    ASSERT_EQ(json["sources"].size(), 2u);
    const Json& sun = json["sources"][0];
    EXPECT_EQ(sun["name"], "command-line sun");
    EXPECT_EQ(sun["direct_in_probes"], false);
    EXPECT_EQ(sun["bounces_in_probes"], true);
    EXPECT_EQ(sun["occlusion_channel"], 0);
    EXPECT_EQ(sun["layer"], "sun");
    EXPECT_EQ(sun["runtime"], "direct × occlusion, shadows of what moves");
    EXPECT_EQ(json["sources"][1]["name"], "sky");
    EXPECT_EQ(json["sources"][1]["layer"], "rest");
    const std::string table =
        succeed({"bake", kCourtyard, "--mixed-lighting", "subtractive", "--explain"}).out;
    EXPECT_TRUE(contains(table, "mixed lighting: subtractive"));
    EXPECT_TRUE(contains(table, "emissive_warm"));
    EXPECT_EQ(file_names(), (std::vector<std::string>{"empty.gltf", "five.json"}));
}

TEST_F(Relight, BakeNeedsAnOutputUnlessItExplains) {
    EXPECT_TRUE(contains(misuse({"bake", "empty.gltf"}), "--output is required"));
}

TEST_F(Relight, LayersOfASceneThatHasNoSuchLightAreAnError) {
    EXPECT_EQ(
        fail({"bake", "empty.gltf", "-g", "five.json", "-o", "v.probes", "--layers", "light:lamp"}),
        "tetralight: layer \"light:lamp\": the scene has no such light; it has none\n");
}

TEST_F(Relight, ShadowmaskVolumesAnswerOcclusion) {
    succeed({"bake", "empty.gltf", "-g", "five.json", "-o", "v.probes", "-s", "16",
             "--sun-direction", "0,-1,0", "--sun-irradiance", "2,2,2", "--mixed-lighting",
             "shadowmask"});
    const std::string out = succeed({"query", "v.probes", "--json"}, "1 1 1").out;
    EXPECT_EQ(Json::parse(out)["occlusion"], (std::vector<double>{1, 1, 1, 1}));
    EXPECT_EQ(run_json({"info", "v.probes"})["lights"][0]["occlusion_channel"], 0);
}

}  // namespace
}  // namespace tetralight::test
