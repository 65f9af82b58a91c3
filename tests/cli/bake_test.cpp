// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include <tetralight/bake/image/write_image.h>
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// Coefficient 0 of the irradiance under constant radiance 1: A_0 · 4π · Y_0.
const double kConstant = std::numbers::pi * 4.0 * std::numbers::pi * 0.282094791773878;

class Bake : public CommandFixture {
  protected:
    Bake() {
        write("empty.gltf", kEmptyScene);
        write("five.json", kFiveProbes);
    }

    /// Bakes with few samples and returns the file's bytes.
    [[nodiscard]] std::string bytes_of(const Arguments& more) const {
        Arguments arguments{"bake", kCourtyard, "-o", "bytes.probes", "-s", "16"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
        return read("bytes.probes");
    }

    /// Bakes five probes in an empty scene and returns coefficient 0 of the one at (1, 1, 1).
    [[nodiscard]] std::vector<double> first_coefficient(const Arguments& light) const {
        Arguments arguments{"bake", "empty.gltf", "-g", "five.json",
                            "-o",   "sky.probes", "-s", "64"};
        arguments.insert(arguments.end(), light.begin(), light.end());
        succeed(arguments);
        const std::string out = succeed({"query", "sky.probes", "--json"}, "1 1 1").out;
        return Json::parse(out)["irradiance_sh"][0].get<std::vector<double>>();
    }

    void expect_radiance(const Arguments& light, const std::vector<double>& radiance) const {
        const auto coefficient = first_coefficient(light);
        for (size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(coefficient[i], kConstant * radiance[i], 2e-3 * kConstant) << i;
        }
    }

    /// A bake that took long enough for progress to show, on a machine of any speed.
    [[nodiscard]] CommandResult long_bake(const Arguments& more) const {
        for (int samples = 8192;; samples *= 2) {
            Arguments arguments{"bake",  kCourtyard, "-o", "long.probes",
                                "-j",    "1",        "-s", std::to_string(samples),
                                "--json"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            CommandResult result = succeed(arguments);
            if (HasFailure() || Json::parse(result.out)["seconds"]["bake"] > 1.5) return result;
        }
    }
};

TEST_F(Bake, TellsOtherProgramsOfTheWorkOfThisRun) {
    // Probes 16 to 31 are all that the store does not hold.
    for (const char* range : {"0..16", "32.."}) {
        succeed({"bake", kCourtyard, "-o", "other.part", "-s", "16", "--probes", range, "--chunks",
                 "chunks"});
    }
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--chunks", "chunks",
             "--progress-file", "progress.json"});
    const Json part =
        run_json({"bake", kCourtyard, "-o", "v.part", "-s", "16", "--probes", "16..32"});
    const Json progress = Json::parse(read("progress.json"));
    EXPECT_EQ(progress["rays"], part["rays"]);
    EXPECT_GT(progress["rays_per_second"], 0);
    EXPECT_EQ(progress["probes_done"], part["all_probes"]);
    EXPECT_EQ(progress["probe_count"], part["all_probes"]);
    EXPECT_EQ(progress["seconds_left"], 0);
}

TEST_F(Bake, JsonHasTheDocumentedFields) {
    const Json json = run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    const std::vector<std::string> expected{"bounces",
                                            "dilated",
                                            "dimension",
                                            "groups",
                                            "hull_cells",
                                            "inner_cells",
                                            "largest_snap",
                                            "lattice_groups",
                                            "layers",
                                            "left_out",
                                            "moved",
                                            "output",
                                            "over_target",
                                            "probes",
                                            "rays",
                                            "rays_per_second",
                                            "reused",
                                            "samples",
                                            "samples_per_probe",
                                            "seconds",
                                            "standard_error",
                                            "unseen",
                                            "walls",
                                            "welded"};  // sorted
    EXPECT_EQ(keys, expected);
}

TEST_F(Bake, LayersTakeSamplesUntilEachIsAtItsTarget) {
    const Arguments layers{"bake",          kCourtyard, "-o",           "v.probes",       "-g",
                           "five.json",     "--layers", "sun,emission", "--target-error", "20%",
                           "--max-samples", "16384"};
    Arguments with_target = layers;
    with_target.insert(with_target.end(), {"--target-layers", "5%"});
    const Json without = run_json(layers);
    const Json with = run_json(with_target);
    EXPECT_EQ(with["layers"][1]["name"], "emission");
    EXPECT_LT(with["layers"][1]["standard_error"]["median"], 0.05);
    EXPECT_GT(with["samples_per_probe"]["max"], without["samples_per_probe"]["max"]);
    EXPECT_TRUE(contains(succeed(with_target).out, "\n  layer emission: median "));
}

TEST_F(Bake, TargetsOfLayersNeedLayers) {
    const std::string error =
        misuse({"bake", kCourtyard, "-o", "v.probes", "--target-layers", "5%"});
    EXPECT_TRUE(contains(error, "--target-layers")) << error;
    EXPECT_TRUE(contains(error, "--layers")) << error;
}

TEST_F(Bake, TextSaysWhatWasMade) {
    const std::string out = succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16"}).out;
    EXPECT_TRUE(contains(out, "v.probes: 255 probes")) << out;
    EXPECT_TRUE(contains(out, " welded, 1 lattice)")) << out;
}

TEST_F(Bake, GivesTheSameBytesForAnyNumberOfThreads) {
    EXPECT_TRUE(bytes_of({"-j", "1"}) == bytes_of({"-j", "2"}));
}

TEST_F(Bake, GivesTheSameBytesForAnyOrderOfGroupFiles) {
    succeed({"grid", kCourtyard, "-o", "grid.json", "--spacing", "8"});
    EXPECT_TRUE(bytes_of({"-g", "grid.json", "--groups", "five.json"}) ==
                bytes_of({"-g", "five.json", "-g", "grid.json"}));
}

TEST_F(Bake, GivesOtherBytesForAnotherSeed) {
    EXPECT_TRUE(bytes_of({"--seed", "1"}) != bytes_of({"--seed", "2"}));
}

TEST_F(Bake, AddsGivenGroupsToThoseOfTheScene) {
    const Json json =
        run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "1", "--groups", "five.json"});
    EXPECT_EQ(json["groups"], 6);
    EXPECT_EQ(json["probes"], 255 + 5 - 1);  // one lies in the ground
}

TEST_F(Bake, LeavesTheGroupsOfTheSceneOutWhenAsked) {
    const Json json = run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "1", "-g", "five.json",
                                "--only-given-groups"});
    EXPECT_EQ(json["groups"], 1);
    EXPECT_EQ(json["probes"], 5 - 1);
}

TEST_F(Bake, TakesOneGroupFileAUseAndLeavesTheSceneAlone) {
    const Json json =
        run_json({"bake", "-s", "1", "-g", "five.json", kCourtyard, "-o", "v.probes"});
    EXPECT_EQ(json["groups"], 6);
}

TEST_F(Bake, NamesTheFilesOfAGroupThatIsThereTwice) {
    write("again.json", kFiveProbes);
    const std::string message = fail_and_keep(
        "v.probes", {"bake", kCourtyard, "-g", "five.json", "-g", "again.json", "-o", "v.probes"});
    EXPECT_TRUE(contains(message, "five.json, again.json: group \"five\": ")) << message;
}

TEST_F(Bake, SaysWhereToGetGroupsWhenThereAreNone) {
    const std::string message = fail_and_keep("v.probes", {"bake", "empty.gltf", "-o", "v.probes"});
    EXPECT_TRUE(contains(message, "empty.gltf: ")) << message;
    EXPECT_TRUE(contains(message, "tetralight grid")) << message;
}

TEST_F(Bake, TakesAConstantSky) {
    expect_radiance({"--sky", "1,0.5,0.25"}, {1.0, 0.5, 0.25});
    expect_radiance({"--sky", "0.5"}, {0.5, 0.5, 0.5});  // grey
}

TEST_F(Bake, SaysWhatASkyMayBe) {
    const std::string message = misuse({"bake", kCourtyard, "-o", "v.probes", "--sky", "1,2"});
    EXPECT_TRUE(contains(message, "\"1,2\" is neither R,G,B, nor a number, nor a file")) << message;
}

TEST_F(Bake, ScalesTheSky) {
    expect_radiance({"--sky", "1,0.5,0.25", "--sky-intensity", "3"}, {3.0, 1.5, 0.75});
}

TEST_F(Bake, TakesASkyImage) {
    ImageF sky;
    sky.width = 8;
    sky.height = 4;
    sky.pixels.assign(32, glm::vec3(0.5f, 0.25f, 2.0f));
    ASSERT_TRUE(write_exr(path("sky.exr"), sky));
    expect_radiance({"--sky", "sky.exr"}, {0.5, 0.25, 2.0});
}

TEST_F(Bake, BakesAnAddedSunThatIsBaked) {
    const auto coefficient =
        first_coefficient({"--sky", "0,0,0", "--sun-direction", "0,-2,0", "--sun-irradiance",
                           "3,2,1", "--sun-mode", "baked"});
    for (size_t i = 0; i < 3; ++i) {
        const double irradiance = 3.0 - static_cast<double>(i);
        EXPECT_NEAR(coefficient[i], std::numbers::pi * 0.282094791773878 * irradiance, 1e-5);
    }
}

TEST_F(Bake, LeavesTheDirectLightOfAMixedSunToTheRuntime) {
    const auto coefficient = first_coefficient(
        {"--sky", "0,0,0", "--sun-direction", "0,-2,0", "--sun-irradiance", "3,2,1"});
    EXPECT_EQ(coefficient, (std::vector<double>{0.0, 0.0, 0.0}));
}

TEST_F(Bake, RecordsTheAddedSunInTheVolume) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "1", "--sun-direction", "1,-1,0",
             "--sun-irradiance", "1,1,1", "--sun-mode", "baked"});
    const Json lights = run_json({"info", "v.probes"})["lights"];
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[1],
              (Json{{"name", "command-line sun"}, {"type", "directional"}, {"mode", "baked"}}));
}

TEST_F(Bake, WithoutAlbedoNothingBounces) {
    const auto light = [&](const Arguments& more) {
        (void)bytes_of(more);
        return Json::parse(succeed({"query", "bytes.probes", "--json"}, "0 2 0").out);
    };
    const Json black = light({"--max-albedo", "0"})["irradiance_sh"][0];
    const Json direct = light({"--bounces", "0"})["irradiance_sh"][0];
    const Json boosted = light({"--albedo-boost", "10"})["irradiance_sh"][0];
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(black[i].get<double>(), direct[i].get<double>(), 1e-5);
        EXPECT_GT(boosted[i].get<double>(), 1.2 * black[i].get<double>());
    }
}

TEST_F(Bake, RefusesAMalformedSun) {
    for (const char* direction : {"1,2", "abc", "0,0,0", "1,2,3,4", "nan,0,0", "1,,2"}) {
        EXPECT_TRUE(contains(misuse({"bake", kCourtyard, "-o", "v.probes", "--sun-direction",
                                     direction, "--sun-irradiance", "1,1,1"}),
                             "--sun-direction"));
    }
    for (const char* irradiance : {"-1,1,1", "1,1", "1e39,1,1", "inf,1,1"}) {
        EXPECT_TRUE(contains(misuse({"bake", kCourtyard, "-o", "v.probes", "--sun-direction",
                                     "0,-1,0", "--sun-irradiance", irradiance}),
                             "--sun-irradiance"));
    }
}

TEST_F(Bake, RefusesBadScenesAndKeepsTheOldVolume) {
    refuse_each(bad_scenes(read(kCourtyard)), "old.probes", [](const std::string& name) {
        return Arguments{"bake", name, "-o", "old.probes"};
    });
}

TEST_F(Bake, RefusesBadGroupsAndKeepsTheOldVolume) {
    refuse_each(bad_groups(), "old.probes", [](const std::string& name) {
        return Arguments{"bake", kCourtyard, "-g", name, "-o", "old.probes"};
    });
}

TEST_F(Bake, RefusesASkyThatCannotBeReadAndKeepsTheOldVolume) {
    write("garbage.hdr", "this is no picture");
    write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n");
    std::filesystem::create_directory(path("folder.hdr"));
    for (const std::string sky : {"garbage.hdr", "cut.hdr", "none.hdr", "folder.hdr"}) {
        const std::string message =
            fail_and_keep("old.probes", {"bake", kCourtyard, "--sky", sky, "-o", "old.probes"});
        EXPECT_TRUE(contains(message, sky + ": ")) << message;
    }
}

TEST_F(Bake, RefusesASkyThatIsTooBrightAndKeepsTheOldVolume) {
    ASSERT_TRUE(write_exr(path("sky.exr"), ImageF{2, 1, {glm::vec3(1e5f), glm::vec3(1.0f)}}));
    const std::string message = fail_and_keep(
        "old.probes",
        {"bake", kCourtyard, "--sky", "sky.exr", "--sky-intensity", "1e30", "-o", "old.probes"});
    EXPECT_TRUE(contains(message, "sky.exr: the sky's radiance")) << message;
}

TEST_F(Bake, SaysWhenNothingShines) {
    const CommandResult result =
        succeed({"bake", "empty.gltf", "-g", "five.json", "-o", "v.probes", "-s", "64", "--json"});
    EXPECT_TRUE(contains(result.err, "warning: no probe receives any light")) << result.err;
    EXPECT_TRUE(Json::parse(result.out)["standard_error"].is_null());
}

TEST_F(Bake, NamesFilesThatAreNotThere) {
    EXPECT_TRUE(contains(fail({"bake", "none.glb", "-o", "v.probes"}), "none.glb: cannot open"));
    EXPECT_TRUE(contains(fail({"bake", kCourtyard, "-g", "none.json", "-o", "v.probes"}),
                         "none.json: cannot open"));
}

TEST_F(Bake, WarnsOfBuriedProbesOnStderr) {
    // Inside the violet box of the courtyard.
    write("buried.json", R"({"groups": [{"name": "buried", "positions":
        [[1.6, 1, -6.4], [1.7, 1, -6.4], [1.6, 1.1, -6.4], [1.6, 1, -6.3]]}]})");
    const CommandResult result =
        succeed({"bake", kCourtyard, "-g", "buried.json", "-o", "v.probes", "-s", "16", "--json"});
    EXPECT_TRUE(contains(result.err, "warning: buried.json: group \"buried\": 4 of 4"))
        << result.err;
    EXPECT_TRUE(Json::accept(result.out));
}

TEST_F(Bake, PrintsPlainProgressLinesWhenStderrIsNoTerminal) {
    const CommandResult result = long_bake({});
    EXPECT_EQ(result.err.find("Progress: "), 0u) << result.err;
    EXPECT_TRUE(contains(result.err, "Progress: 100%, 255/255 probes")) << result.err;
    EXPECT_EQ(result.err.find_first_of("\r\x1b"), std::string::npos) << result.err;
}

TEST_F(Bake, PrintsNoProgressWhenQuiet) {
    EXPECT_EQ(long_bake({"--quiet"}).err, "");
}

TEST_F(Bake, SamplesUntilEveryProbeIsBelowTheTarget) {
    const Json json = run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "128", "--target-error",
                                "10%", "--max-samples", "1000000"});
    EXPECT_EQ(json["over_target"], 0);
    EXPECT_LE(json["standard_error"]["worst"], 0.1);
    EXPECT_EQ(json["samples_per_probe"]["min"], 128);
    EXPECT_GT(json["samples_per_probe"]["max"], 128);
}

TEST_F(Bake, TakesWhatHalfAPercentNeedsWhenToldNothing) {
    const auto made_with = [&](const Arguments& more) {
        Arguments arguments{"bake", "empty.gltf", "-g", "five.json", "-o", "v.probes"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
        return run_json({"info", "v.probes"})["made_with"];
    };
    const Json by_default = made_with({});
    EXPECT_EQ(by_default["samples"], 1024);
    EXPECT_EQ(by_default["target_error"], 0.005);
    EXPECT_EQ(by_default["max_samples"], 131072);
    EXPECT_FALSE(made_with({"-s", "2"}).contains("target_error"));
    EXPECT_FALSE(made_with({"--time-budget", "0.1s"}).contains("target_error"));
    EXPECT_FALSE(made_with({"--target-error", "20%"}).contains("max_samples"));
}

TEST_F(Bake, SaysWhichProbesAreAboveTheTarget) {
    const CommandResult result = succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "128",
                                          "--target-error", "1e-9", "--max-samples", "256"});
    EXPECT_TRUE(contains(result.err, "of 255 probes have a standard error above 1e-09 (the worst "))
        << result.err;
    EXPECT_TRUE(contains(result.out, "above the target")) << result.out;
}

TEST_F(Bake, StopsRoundsWhenTheTimeIsSpent) {
    const Json json =
        run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "128", "--time-budget", "0.5s"});
    EXPECT_EQ(json["over_target"], 0);
    EXPECT_GT(json["samples_per_probe"]["max"], 128);
}

TEST_F(Bake, GivesTheSameBytesForAnyNumberOfThreadsWithATarget) {
    EXPECT_TRUE(bytes_of({"-j", "1", "--target-error", "0.2", "--max-samples", "512"}) ==
                bytes_of({"-j", "2", "--target-error", "20%", "--max-samples", "512"}));
}

TEST_F(Bake, RecordsThatItWasClamped) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "1", "--clamp", "2.5"});
    EXPECT_EQ(run_json({"info", "v.probes"})["made_with"]["clamp"], 2.5);
}

TEST_F(Bake, SaysHowAmountsAreWritten) {
    const auto message = [&](const Arguments& more) {
        Arguments arguments{"bake", kCourtyard, "-o", "v.probes"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return misuse(arguments);
    };
    for (const char* share : {"0", "-1%", "101%", "2", "%", "1 %", "nan", "x", "1%%"}) {
        EXPECT_TRUE(contains(message({"--target-error", share}), "such as 1% or 0.01")) << share;
    }
    for (const char* time : {"0", "-1s", "s", "1d", "1e99h", "nan", "5 m", "inf"}) {
        EXPECT_TRUE(contains(message({"--time-budget", time}), "such as 30s, 5m or 2h")) << time;
    }
    for (const char* range : {"0", "..", "..5", "5..5", "6..5", "-1..5", "0..5x", "0...5"}) {
        EXPECT_TRUE(contains(message({"--probes", range}),
                             "such as 0..100, 100.., or 3..100x8 for every eighth"))
            << range;
    }
    EXPECT_TRUE(contains(message({"--max-samples", "4096"}), "--target-error or --time-budget"));
}

TEST_F(Bake, ThePreviewEndsAsTheFinishedVolume) {
    EXPECT_EQ(bytes_of({"--preview", "look.probes"}), bytes_of({}));
    EXPECT_EQ(read("look.probes"), read("bytes.probes"));
}

TEST_F(Bake, RefusesPreviewsThatCannotBeWritten) {
    const auto message = [&](const std::string& preview) {
        return fail({"bake", kCourtyard, "-o", "v.probes", "--preview", preview});
    };
    EXPECT_TRUE(contains(message("none/p.probes"), "there is no folder none"));
    EXPECT_TRUE(contains(message("v.probes"), "v.probes: is another file of this command"));
    EXPECT_TRUE(
        contains(misuse({"bake", kCourtyard, "-o", "v.probes", "--preview", "p.png"}), ".probes"));
    EXPECT_TRUE(contains(
        misuse({"bake", kCourtyard, "-o", "v.part", "--probes", "0..3", "--preview", "p.probes"}),
        "--preview"));
}

TEST_F(Bake, RefusesAMaximumBelowTheFirstRound) {
    EXPECT_TRUE(contains(misuse({"bake", kCourtyard, "-o", "v.probes", "--target-error", "1%",
                                 "--max-samples", "1000"}),
                         "--max-samples: 1000 is less than the 1024 samples of the first round"));
}

}  // namespace
}  // namespace tetralight::test
