// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/cli/command_fixture.h"
#include "tests/cli/picture.h"
#include "tests/cli/piped_command.h"

namespace tetralight::test {
namespace {

class Lightmap : public CommandFixture {
  protected:
    /// Coarse lightmaps of the courtyard.
    [[nodiscard]] static Arguments arguments(const std::string& output, const Arguments& more) {
        Arguments all{"lightmap", kCourtyard,  "-o", output,        "--texels-per-meter",
                      "1",        "--samples", "32", "--page-size", "256"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// The same in several pages.
    [[nodiscard]] static Arguments in_pages(const std::string& output, const Arguments& more) {
        Arguments all = arguments(output, more);
        *std::ranges::find(all, "256") = "64";
        return all;
    }

    void bake(const std::string& output, const Arguments& more = {}) const {
        succeed(arguments(output, more));
    }
};

TEST_F(Lightmap, BakesTheSameBytesWithAnyNumberOfThreads) {
    bake("one.lightmaps", {"--threads", "1"});
    bake("two.lightmaps", {"--threads", "2"});
    EXPECT_FALSE(read("one.lightmaps").empty());
    EXPECT_EQ(read("one.lightmaps"), read("two.lightmaps"));
}

TEST_F(Lightmap, JsonCountsTexelsChartsAndSeams) {
    const Json json = run_json(arguments("c.lightmaps", {}));
    EXPECT_EQ(json["output"], "c.lightmaps");
    EXPECT_GE(json["charts"], 100);
    EXPECT_EQ(json["texels"], json["invalid"].get<int>() + json["baked"].get<int>());
    EXPECT_GE(json["pages"], 1);
    const Json info = run_json({"info", "c.lightmaps"});
    EXPECT_EQ(info["pages"], json["pages"]);
    EXPECT_EQ(info["made_with"]["texels_per_meter"], 1);
    EXPECT_EQ(info["made_with"]["samples"], 32);
    EXPECT_EQ(run_json({"validate", "c.lightmaps"})["is_valid"], true);
}

TEST_F(Lightmap, RelightSetsWeightsOfLayers) {
    bake("c.lightmaps", {"--layers", "sky"});
    succeed({"relight", "c.lightmaps", "--weights", "sky=0", "-o", "dark.lightmaps"});
    succeed({"relight", "dark.lightmaps", "--weights", "sky=1", "-o", "again.lightmaps"});
    EXPECT_NE(read("dark.lightmaps"), read("c.lightmaps"));
    const Json layers = run_json({"info", "dark.lightmaps"})["layers"];
    EXPECT_EQ(layers[0], Json::parse(R"({"name": "sky", "weight": 0.0})"));
    const std::string error =
        fail({"relight", "c.lightmaps", "--weights", "lamp=0", "-o", "x.lightmaps"});
    EXPECT_TRUE(contains(error, "c.lightmaps: ")) << error;
    EXPECT_TRUE(contains(error, "sky")) << error;
}

TEST_F(Lightmap, RelightRefusesWhatLightmapsCannotDo) {
    bake("c.lightmaps", {"--layers", "sky"});
    EXPECT_TRUE(contains(fail({"relight", "c.lightmaps", "--sky", "2", "-o", "x.lightmaps"}),
                         "contains lightmaps"));
    EXPECT_TRUE(contains(fail({"relight", "c.lightmaps", "--weights", "sky=2", "-o", "x.probes"}),
                         "c.lightmaps: contains no probes"));
    write("empty", "");
    EXPECT_TRUE(contains(fail({"relight", "empty", "--weights", "sky=2", "-o", "x.lightmaps"}),
                         "empty: contains no lightmaps"));
}

TEST_F(Lightmap, RefusesRangesBeyondTheTexelsByOptionAndScene) {
    const std::string count =
        std::to_string(run_json(arguments("c.lightmaps", {}))["baked"].get<int>());
    for (const std::string texels : {"5..99999999", "99999999.."}) {
        const std::string error = fail(arguments("c.part", {"--texels", texels}));
        EXPECT_TRUE(contains(error, kCourtyard + ": --texels: " + texels + " is not within the " +
                                        count + " texels that are baked, 0.." + count))
            << error;
    }
}

TEST_F(Lightmap, StoresGiveTheSameBytes) {
    bake("whole.lightmaps");
    bake("first.lightmaps", {"--store", "store"});
    const Json again = run_json(arguments("second.lightmaps", {"--store", "store"}));
    EXPECT_EQ(read("first.lightmaps"), read("whole.lightmaps"));
    EXPECT_EQ(read("second.lightmaps"), read("whole.lightmaps"));
}

TEST_F(Lightmap, PartsMergeToTheBytesOfOneBake) {
    const Arguments more{"--layers", "sky", "--target-error", "20%", "--max-samples", "256"};
    const auto part = [&](const char* texels, Arguments other) {
        other.insert(other.end(), more.begin(), more.end());
        other.insert(other.end(), {"--texels", texels});
        return other;
    };
    bake("whole.lightmaps", more);
    const Json json = run_json(arguments("a.part", part("0..100", {"--threads", "1"})));
    EXPECT_EQ(json["range"], Json::array({0, 100}));
    EXPECT_EQ(json["texels"], 100);
    EXPECT_GT(json["all_texels"], 1000);
    bake("b.part", part("100..101", {"--store", "store"}));
    bake("c.part", part("101..", {"--resume"}));
    const Json merged = run_json({"merge", "c.part", "a.part", "b.part", "-o", "m.lightmaps"});
    EXPECT_EQ(merged["parts"], 3);
    EXPECT_EQ(merged["baked"], json["all_texels"]);
    EXPECT_TRUE(read("m.lightmaps") == read("whole.lightmaps"));
    const Json info = run_json({"info", "b.part"});
    EXPECT_EQ(info["part"]["range"], Json::array({100, 101}));
    EXPECT_EQ(info["part"]["all_texels"], json["all_texels"]);
}

TEST_F(Lightmap, MergeNamesWhatIsMissingAndKeepsTheOldFile) {
    bake("a.part", {"--texels", "0..100"});
    bake("b.part", {"--texels", "99..200"});
    bake("other.part", {"--texels", "100..", "--seed", "1"});
    succeed({"bake", kCourtyard, "-o", "probes.part", "-s", "16", "-q", "--probes", "0..9"});
    const auto refusal = [&](const Arguments& parts) {
        Arguments all{"merge"};
        all.insert(all.end(), parts.begin(), parts.end());
        all.insert(all.end(), {"-o", "old.lightmaps"});
        return fail_and_keep("old.lightmaps", all);
    };
    EXPECT_TRUE(contains(refusal({"a.part"}), "are in no part; the last, 0..100, are in a.part"));
    EXPECT_TRUE(contains(refusal({"a.part", "b.part"}),
                         "b.part: texels 99..200 overlap texels 0..100 of a.part"));
    EXPECT_TRUE(
        contains(refusal({"a.part", "other.part"}), "other.part: is of another bake than a.part"));
    EXPECT_TRUE(contains(refusal({"a.part", "probes.part"}),
                         "probes.part: contains probes, but a.part contains lightmaps"));
    EXPECT_TRUE(contains(refusal({"probes.part"}), "probes.part: contains no lightmaps"));
    EXPECT_TRUE(contains(fail({"merge", "a.part", "-o", "v.probes"}), "contains no probes"));
}

TEST_F(Lightmap, DamagedPartsAreRefusedByName) {
    bake("sound.part", {"--texels", "0.."});
    const std::string bytes = read("sound.part");
    std::string damaged = bytes;
    damaged[damaged.size() / 2] ^= 1;
    write("damaged.part", damaged);
    write("cut.part", bytes.substr(0, bytes.size() / 2));
    for (const std::string name : {"damaged.part", "cut.part"}) {
        const std::string error =
            fail_and_keep("old.lightmaps", {"merge", name, "-o", "old.lightmaps"});
        EXPECT_TRUE(contains(error, name + ": ")) << error;
    }
}

TEST_F(Lightmap, PartsAndLightmapsAreNotMistakenForEachOther) {
    EXPECT_TRUE(contains(misuse(arguments("c.part", {})), "--output"));
    EXPECT_TRUE(contains(misuse(arguments("c.lightmaps", {"--texels", "0..5"})), "--output"));
    bake("c.part", {"--texels", "0..5", "--layers", "sky"});
    EXPECT_TRUE(contains(fail({"relight", "c.part", "--weights", "sky=0", "-o", "x.lightmaps"}),
                         "merge its parts first"));
    bake_courtyard("v.probes");
    EXPECT_TRUE(
        contains(fail({"render", kCourtyard, "v.probes", "--lightmaps", "c.part", "-o", "x.png"}),
                 "c.part: is a part of a bake; merge its parts first"));
    for (const std::string output : {"x.png", "x.exr", "x.ktx2"})
        EXPECT_TRUE(contains(fail({"export", "c.part", "-o", output}), "c.part: "));
}

TEST_F(Lightmap, RefusesAnObjectThatFitsInNoPageAndKeepsTheOldFile) {
    write("c.lightmaps", "old");
    const std::string error = fail_and_keep(
        "c.lightmaps", {"lightmap", kCourtyard, "-o", "c.lightmaps", "--page-size", "256"});
    EXPECT_TRUE(contains(error, "object \"")) << error;
    EXPECT_TRUE(contains(error, "256")) << error;
}

TEST_F(Lightmap, RefusesUnknownObjectsAndLayers) {
    EXPECT_TRUE(contains(fail(arguments("c.lightmaps", {"--only", "nothing"})), "\"nothing\""));
    EXPECT_TRUE(contains(fail(arguments("c.lightmaps", {"--layers", "transfer"})), "transfer"));
    EXPECT_TRUE(contains(misuse(arguments("c.probes", {})), ".lightmaps"));
    misuse(arguments("c.lightmaps", {"--max-samples", "16"}));
    const std::string error = misuse(arguments("c.lightmaps", {"--max-samples", "127"}));
    EXPECT_TRUE(contains(error,
                         "--max-samples: 127 is less than the 128 samples of the first "
                         "round"))
        << error;
}

TEST_F(Lightmap, RenderUsesThemForStaticObjects) {
    bake_courtyard("v.probes");
    bake("c.lightmaps");
    const Arguments picture{"render", kCourtyard,    "v.probes", "--width",    "24", "--height",
                            "16",     "--antialias", "1",        "--exposure", "1",  "-o"};
    Arguments plain = picture, mapped = picture;
    plain.push_back("plain.png");
    mapped.insert(mapped.end(), {"mapped.png", "--lightmaps", "c.lightmaps"});
    succeed(plain);
    succeed(mapped);
    EXPECT_NE(read("plain.png"), read("mapped.png"));
    write("other.gltf", kEmptyScene);
    const std::string error =
        fail({"render", "other.gltf", "v.probes", "--lightmaps", "c.lightmaps", "-o", "x.png"});
    EXPECT_TRUE(contains(error, "the lightmaps have")) << error;
}

TEST_F(Lightmap, ATimeBudgetCanBeRepeatedByItsSamples) {
    const Json json = run_json(arguments("a.lightmaps", {"--time-budget", "0.5s"}));
    const Json samples = json["samples_per_texel"];
    EXPECT_EQ(samples["min"], samples["max"]);
    EXPECT_GE(samples["max"], 128);
    const std::string most = std::to_string(samples["max"].get<int>());
    bake("b.lightmaps", {"--max-samples", most});
    EXPECT_TRUE(read("a.lightmaps") == read("b.lightmaps"));
    EXPECT_EQ(run_json({"info", "a.lightmaps"})["made_with"]["max_samples"], samples["max"]);
}

TEST_F(Lightmap, TheProgressFileEndsWithTheTexelsAtTheTargetOfTheReport) {
    // Error bars of filtered light are not those of a texel's own samples.
    std::vector<int> over_target;
    for (const Arguments& filter : {Arguments{}, Arguments{"--no-filter"}}) {
        Arguments all{"--target-error",  "2%",           "--max-samples", "256",
                      "--progress-file", "progress.json"};
        all.insert(all.end(), filter.begin(), filter.end());
        const Json json = run_json(arguments("a.lightmaps", all));
        const Json progress = Json::parse(read("progress.json"));
        const int baked = json["baked"], at_target = progress["at_target"];
        over_target.push_back(json["over_target"]);
        EXPECT_EQ(progress["texels_done"], baked);
        EXPECT_EQ(progress["texel_count"], baked);
        EXPECT_FALSE(progress.contains("probe_count"));
        EXPECT_EQ(at_target, baked - over_target.back());
        EXPECT_NEAR(progress["share_at_target"], double(at_target) / baked, 1e-6);
    }
    EXPECT_GT(over_target[0], 0);
    EXPECT_NE(over_target[0], over_target[1]);
    bake("b.lightmaps", {"--progress-file", "progress.json"});
    EXPECT_TRUE(Json::parse(read("progress.json"))["at_target"].is_null());
}

TEST_F(Lightmap, ThePreviewEndsAsTheFinishedPages) {
    succeed(in_pages("plain.lightmaps", {}));
    succeed(in_pages("a.lightmaps", {"--preview", "look.png", "--preview", "light.exr", "--preview",
                                     "all.lightmaps"}));
    EXPECT_EQ(read("a.lightmaps"), read("plain.lightmaps"));
    EXPECT_EQ(read("all.lightmaps"), read("a.lightmaps"));
    const int pages = run_json({"info", "a.lightmaps"})["pages"];
    succeed({"export", "a.lightmaps", "--as", "preview", "-o", "x.png"});
    succeed({"export", "a.lightmaps", "-o", "y.exr"});
    ASSERT_GT(pages, 1);
    for (int page = 0; page < pages; ++page) {
        const std::string number = "_" + std::to_string(page);
        EXPECT_TRUE(read("look" + number + ".png") == read("x" + number + ".png"));
        EXPECT_TRUE(read("light" + number + ".exr") == read("y" + number + ".exr"));
    }
}

TEST_F(Lightmap, RefusesPreviewsThatCannotBeWritten) {
    const auto refusal = [&](const Arguments& more) {
        const std::string message = fail(arguments("a.lightmaps", more));
        EXPECT_TRUE(file_names().empty());
        return message;
    };
    EXPECT_TRUE(contains(refusal({"--preview", "none/p.png"}), "there is no folder none"));
    EXPECT_TRUE(contains(refusal({"--preview", "a.lightmaps"}),
                         "a.lightmaps: is another file of this command"));
    EXPECT_TRUE(contains(refusal({"--preview", "p.png", "--preview", "p.png"}),
                         "p.png: is another file of this command"));
    EXPECT_TRUE(contains(misuse(arguments("a.lightmaps", {"--preview", "p.jpg"})),
                         "expected a .png, .exr or .lightmaps file"));
    // Of several pages each has a file.
    std::filesystem::create_directory(folder() / "p_1.png");
    EXPECT_TRUE(contains(fail(in_pages("a.lightmaps", {"--preview", "p.png"})),
                         "p_1.png: cannot write (is a folder)"));
}

TEST_F(Lightmap, WritesTheUnwrappedSceneThatUnwrapWrites) {
    bake("a.lightmaps", {"--unwrapped", "during.glb"});
    succeed(
        {"unwrap", kCourtyard, "-o", "alone.glb", "--texels-per-meter", "1", "--page-size", "256"});
    EXPECT_TRUE(read("during.glb") == read("alone.glb"));
    EXPECT_TRUE(contains(misuse(arguments("a.lightmaps", {"--unwrapped", "a.obj"})), ".glb"));
    EXPECT_TRUE(contains(fail(arguments("b.lightmaps", {"--unwrapped", "none/a.glb"})),
                         "there is no folder none"));
}

TEST_F(Lightmap, ExplainsWithoutBaking) {
    const Json json = run_json({"lightmap", kCourtyard, "--explain"});
    EXPECT_EQ(json["sources"], run_json({"bake", kCourtyard, "--explain"})["sources"]);
    EXPECT_TRUE(file_names().empty());
    EXPECT_TRUE(
        contains(fail({"lightmap", kCourtyard, "--explain", "--only", "nothing"}), "\"nothing\""));
    EXPECT_TRUE(contains(misuse({"lightmap", kCourtyard}), "--output is required"));
}

/// Bakes until its folder of previews was removed before the bake was over.
TEST_F(Lightmap, APreviewThatFailsLaterWarnsAndEndsNothing) {
    for (int samples = 1024;; samples *= 2) {
        std::filesystem::create_directory(folder() / "look");
        RunningCommand bake(folder(),
                            {"lightmap", kCourtyard, "-o", "a.lightmaps", "--texels-per-meter", "1",
                             "--samples", std::to_string(samples), "--preview", "look/p.png",
                             "--progress-file", "progress.json"},
                            "");
        while (!std::filesystem::exists(path("progress.json")))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::filesystem::remove_all(folder() / "look");
        const CommandResult result = bake.wait();
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(run_json({"validate", "a.lightmaps"})["is_valid"], true);
        std::filesystem::remove(path("progress.json"));
        if (!contains(result.err, "the preview is not up to date: look/p.png: ")) continue;
        EXPECT_FALSE(std::filesystem::exists(folder() / "look"));
        return;
    }
}

}  // namespace
}  // namespace tetralight::test
