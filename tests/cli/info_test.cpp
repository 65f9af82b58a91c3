// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/probe_file.h>
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

TEST_F(Info, TextSaysInAlignedLinesWhatTheVolumeHolds) {
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "v.probes"});
    const std::string out = succeed({"info", "v.probes"}).out;
    for (const char* line :
         {"v.probes\n", "  probes     5 (0 welded), in 1 group\n", "  dimension  space\n",
          "  cells      4 tetrahedra, 4 hull cells\n",
          "  slivers    0 of quality < 1e-3 (0.0 %), 0 < 1e-6 (0.0 %)\n",
          "  bounds     0 0 0  to  8 8 8\n", "  light      none (not baked)\n",
          "probes by group\n  five  5  100.0 %\n", "  exact_positions    120 B"}) {
        EXPECT_TRUE(contains(out, line)) << line << "\n" << out;
    }
    EXPECT_FALSE(Json::accept(out));
}

TEST_F(Info, TextOfOneProbeHasNoSlivers) {
    write("one.json", R"({"groups": [{"name": "\u00e9", "positions": [[1, 2, 3]]}]})");
    succeed({"tetrahedralize", "one.json", "-o", "v.probes"});
    const std::string out = succeed({"info", "v.probes"}).out;
    EXPECT_TRUE(contains(out, "  cells      1 cell, 0 hull cells\n")) << out;
    EXPECT_TRUE(contains(out, "  \xc3\xa9  1  100.0 %\n")) << out;
    EXPECT_FALSE(contains(out, "slivers")) << out;
    EXPECT_TRUE(run_json({"info", "v.probes"})["slivers"].is_null());
}

TEST_F(Info, SaysHowWalksFindTheirCells) {
    bake_courtyard("v.probes");
    const Json info = run_json({"info", "v.probes"});
    const Json &seeds = info["seeds"], &walks = info["walks"];
    EXPECT_GE(seeds["count"], 255);  // several voxels a probe
    EXPECT_EQ(walks["positions"], 10000);
    EXPECT_GT(seeds["hit_rate"], 0.0);
    EXPECT_LT(seeds["hit_rate"], 1.0);
    EXPECT_GT(seeds["mean_steps"], 1.0);
    EXPECT_LE(walks["p50_steps"], walks["p99_steps"]);
    EXPECT_LE(walks["p99_steps"], walks["max_steps"]);
    EXPECT_EQ(walks["fallbacks"], 0);
    EXPECT_EQ(run_json({"info", "v.probes"}), info);
}

TEST_F(Info, CountsTheSeedsOfAVolumeWithoutASeedGrid) {
    bake_courtyard("v.probes");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    ProbeVolume volume = copy_volume(file->view());
    volume.seed_grid.clear();
    make_seeds(volume);
    ASSERT_TRUE(write_probe_file(path("old.probes"), volume.view()));
    EXPECT_EQ(run_json({"info", "old.probes"})["seeds"]["count"],
              32);  // one for eight of 255 probes
}

TEST_F(Info, SaysWhatIsKnownOfWalls) {
    const Json baked =
        Json::parse(succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--json"}).out);
    const Json info = run_json({"info", "v.probes"})["visibility"];
    EXPECT_EQ(info["marked_cells"], baked["walls"]["marked_cells"]);
    EXPECT_EQ(info["blocked_edges"], baked["walls"]["blocked_edges"]);
    EXPECT_EQ(info["edges"], baked["walls"]["edges"]);
    EXPECT_EQ(info["unknown_edges"], 0);
    EXPECT_GT(info["blocked_edges"], 0);
    EXPECT_TRUE(contains(succeed({"info", "v.probes"}).out, "  walls      "));
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    EXPECT_TRUE(run_json({"info", "unlit.probes"})["visibility"].is_null());
    EXPECT_TRUE(contains(succeed({"info", "unlit.probes"}).out, "  walls      not known\n"));
}

TEST_F(Info, SaysWhatTheBakeFoundOfWalls) {
    const Json baked = run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    const Json info = run_json({"info", "v.probes"});
    EXPECT_EQ(info["visibility"]["unclear_cells"], baked["walls"]["unclear_cells"]);
    EXPECT_EQ(info["visibility"]["left_out_probes"], baked["walls"]["left_out_probes"]);
    EXPECT_EQ(info["unseen"], baked["unseen"]);
    EXPECT_EQ(info["unseen"]["places"], 4096);
    EXPECT_TRUE(contains(succeed({"info", "v.probes"}).out, "of free space sees no probe of its "));
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    EXPECT_TRUE(run_json({"info", "unlit.probes"})["unseen"].is_null());
    EXPECT_TRUE(contains(succeed({"info", "unlit.probes"}).out, "  unseen     not known\n"));
}

TEST_F(Info, SaysHowManyProbesAreOnEachRenderingLayer) {
    write("layers.json", R"({"groups": [
        {"name": "a", "rendering_layers": [0, 3], "positions": [[0, 0, 0], [8, 0, 0]]},
        {"name": "b", "rendering_layers": [31], "positions": [[8, 0, 0], [0, 8, 0]]},
        {"name": "c", "positions": [[0, 0, 8], [9, 9, 9]]}]})");
    succeed({"tetrahedralize", "layers.json", "-o", "v.probes"});
    const Json expected{{"list",
                         {{{"layer", 0}, {"probes", 2}},
                          {{"layer", 3}, {"probes", 2}},
                          {{"layer", 31}, {"probes", 2}}}},
                        {"probes_on_all", 2}};
    EXPECT_EQ(run_json({"info", "v.probes"})["rendering_layers"], expected);
    const std::string out = succeed({"info", "v.probes"}).out;
    EXPECT_TRUE(contains(out,
                         "  rendering layers  0 (2 probes), 3 (2 probes), 31 (2 probes), all (2 "
                         "probes)\n"))
        << out;
    std::map<Json, size_t> layer_counts;  // of probes, by their groups
    const Json info = run_json({"info", "v.probes", "--probes"});
    for (const Json& probe : info["probe_list"]) {
        layer_counts[probe["groups"]] = probe["rendering_layers"].size();
    }
    EXPECT_EQ(layer_counts, (std::map<Json, size_t>{{Json::array({"a"}), 2},
                                                    {Json::array({"a", "b"}), 3},
                                                    {Json::array({"b"}), 1},
                                                    {Json::array({"c"}), 32}}));
}

TEST_F(Info, SaysNothingOfRenderingLayersWhereAllProbesAreOnAll) {
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "v.probes"});
    const Json info = run_json({"info", "v.probes", "--probes"});
    EXPECT_TRUE(info["rendering_layers"].is_null());
    EXPECT_TRUE(info["probe_list"][0]["rendering_layers"].is_null());
    EXPECT_FALSE(contains(succeed({"info", "v.probes"}).out, "rendering layers"));
}

TEST_F(Info, SeedOfOneProbeAlwaysHits) {
    write("one.json", R"({"groups": [{"name": "one", "positions": [[1, 2, 3]]}]})");
    succeed({"tetrahedralize", "one.json", "-o", "v.probes"});
    const Json info = run_json({"info", "v.probes"});
    EXPECT_EQ(info["seeds"]["hit_rate"], 1.0);
    EXPECT_EQ(info["walks"]["max_steps"], 1);
    const std::string out = succeed({"info", "v.probes"}).out;
    for (const char* line :
         {"  seeds      1, in the cell asked for: 100.0 %, 1.0 steps in the mean\n",
          "  walks      p50 1, p99 1, max 1 step, 0 fallbacks of 10 000\n"}) {
        EXPECT_TRUE(contains(out, line)) << out;
    }
}

TEST_F(Info, CountsSlivers) {
    // Over four corners of a square the fifth probe makes cells of quality 6√2 · V / rms³: about
    // 1e-3 · 2 · √2 · h for a small height h.
    write("flat.json", R"({"groups": [{"name": "flat", "positions":
        [[0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 1e-4, 1], [0.3, 5, 0.4]]}]})");
    succeed({"tetrahedralize", "flat.json", "-o", "v.probes"});
    const Json slivers = run_json({"info", "v.probes"})["slivers"];
    EXPECT_EQ(slivers["below_1e-3"], 1) << slivers;
    EXPECT_EQ(slivers["below_1e-6"], 0) << slivers;
}

TEST_F(Info, MemoryAddsUp) {
    bake_courtyard("v.probes");
    const Json info = run_json({"info", "v.probes"});
    uint64_t sum = 0;
    for (const auto& [name, bytes] : info["section_bytes"].items()) sum += bytes.get<uint64_t>();
    EXPECT_EQ(info["bytes"], sum);
    EXPECT_EQ(info["resident_bytes"].get<uint64_t>() + info["cold_bytes"].get<uint64_t>(), sum);
    EXPECT_DOUBLE_EQ(info["bytes_per_probe"], static_cast<double>(sum) / 255.0);
    EXPECT_EQ(info["section_bytes"]["positions"], 255 * 12);
}

TEST_F(Info, WritesTheTetrahedraAsAWireframe) {
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "v.probes"});
    succeed({"info", "v.probes", "--obj", "v", "--ply", "w.PLY"});
    // Five probes, of which each is joined with each: 6 edges of the hull and 4 within.
    const std::string obj = read("v");
    const std::string inner =
        obj.substr(obj.find("g cells\n"), obj.find("g hull\n") - obj.find("g cells\n"));
    EXPECT_EQ(std::count(inner.begin(), inner.end(), '\n'), 1 + 4);
    const std::string hull = obj.substr(obj.find("g hull\n"));
    EXPECT_EQ(std::count(hull.begin(), hull.end(), '\n'), 1 + 6);
    EXPECT_TRUE(contains(read("w.PLY"), "element vertex 5\n"));
    EXPECT_TRUE(contains(read("w.PLY"), "element edge 10\n"));
}

TEST_F(Info, KeepsStdoutForTheWireframeThatGoesThere) {
    bake_courtyard("v.probes");
    succeed({"info", "v.probes", "--obj", "v.obj"});
    EXPECT_EQ(succeed({"info", "v.probes", "--obj", "-"}).out, read("v.obj"));
    EXPECT_TRUE(contains(misuse({"info", "v.probes", "--obj", "-", "--ply", "-"}), "--ply"));
}

TEST_F(Info, NamesAWireframeThatCannotBeWritten) {
    bake_courtyard("v.probes");
    EXPECT_TRUE(contains(fail({"info", "v.probes", "--obj", "none/v.obj"}), "none/v.obj: cannot"));
    write("volume", read("v.probes"));
    EXPECT_TRUE(contains(fail({"info", "volume", "--ply", "volume"}), "is an input"));
    EXPECT_TRUE(contains(misuse({"info", "v.probes", "--ply", ""}), "--ply: the path is empty"));
}

TEST_F(Info, RefusesToWriteAWireframeOverFilesOfOtherFormats) {
    for (const char* option : {"--obj", "--ply"}) {
        for (const char* name : {"scene.glb", "v.probes", "notes.txt"}) {
            const std::string message = misuse({"info", "v.probes", option, name});
            EXPECT_TRUE(contains(message, std::string(option) + ": cannot write \".")) << message;
        }
    }
    EXPECT_TRUE(file_names().empty());
}

TEST_F(Info, RefusesTwoWireframesInOneFile) {
    write("there", "");
    for (const auto& [obj, ply] :
         {std::pair<std::string, std::string>("v", "v"), {"v", "./v"}, {"there", path("there")}}) {
        const std::string message = misuse({"info", "v.probes", "--obj", obj, "--ply", ply});
        EXPECT_TRUE(contains(message, "--ply: --obj goes to the same file")) << message;
    }
}

TEST_F(Info, RefusesBadVolumes) {
    bake_courtyard("sound.probes");
    refuse_each(bad_volumes(read("sound.probes")), "", [](const std::string& name) {
        return Arguments{"info", name};
    });
}

TEST_F(Info, RefusesMetadataThatIsNestedTooDeep) {
    ProbeVolume volume;
    volume.metadata = std::string(200000, '[');
    ASSERT_TRUE(write_probe_file(path("deep.probes"), volume.view()));
    EXPECT_TRUE(contains(fail({"info", "deep.probes"}),
                         "deep.probes: section \"metadata\": JSON is nested deeper than 64"));
}

TEST_F(Info, NamesAVolumeThatIsNotThere) {
    EXPECT_TRUE(contains(fail({"info", "none.probes"}), "none.probes: cannot open"));
    EXPECT_TRUE(contains(fail({"info", "."}), ".: is a folder"));
}

TEST_F(Info, TakesAPathThatIsNotUtf8) {
    bake_courtyard("\xff.probes");
    EXPECT_EQ(run_json({"info", "\xff.probes"})["file"], "\xef\xbf\xbd.probes");
}

}  // namespace
}  // namespace tetralight::test
