// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <initializer_list>
#include <thread>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Grid : public CommandFixture {};

TEST_F(Grid, WritesTheProbesThatItCounts) {
    const Json json = run_json({"grid", kCourtyard, "-o", "grid.json", "--spacing", "4"});
    const Json groups = Json::parse(read("grid.json"))["groups"];
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0]["positions"].size(), json["probes"]);
    const auto sum = [&](std::initializer_list<const char*> keys) {
        int count = 0;
        for (const char* key : keys) count += json[key].get<int>();
        return count;
    };
    EXPECT_EQ(sum({"kept_in_place", "pushed", "added"}), json["probes"]);
    const int all = sum({"probes", "inside_geometry", "too_close", "unreachable", "without_light",
                         "forbidden", "crowded"});
    EXPECT_EQ(all, json["candidates"]);
    int in_bins = 0;
    for (const Json& bin : json["surface_distance"]) in_bins += bin["probes"].get<int>();
    EXPECT_EQ(in_bins, json["probes"]);
}

TEST_F(Grid, ReportsSpacesAndCoverage) {
    const Json json = run_json({"grid", kCourtyard, "-o", "grid.json", "--spacing", "4"});
    int in_spaces = 0;
    for (const Json& space : json["spaces"]) {
        EXPECT_EQ(space["position"].size(), 3u);
        EXPECT_GT(space["volume"], 0.0);
        EXPECT_EQ(space["from"], false);
        if (space["fate"] == "filled") in_spaces += space["probes"].get<int>();
    }
    EXPECT_EQ(in_spaces, json["probes"]);
    EXPECT_EQ(json["spaces"][0]["sky"], true);
    const Json& coverage = json["coverage"];
    EXPECT_GT(coverage["places"], 1000);
    EXPECT_GE(coverage["covered"], 0.97);
    EXPECT_NEAR(coverage["covered"].get<double>() + coverage["outside"].get<double>() +
                    coverage["unseen"].get<double>(),
                1.0, 1e-9);
}

TEST_F(Grid, SaysWhichSpaceHoldsASeed) {
    const Json json =
        run_json({"grid", kCourtyard, "-o", "grid.json", "--spacing", "4", "--from", "0,2,0"});
    for (const Json& space : json["spaces"]) {
        EXPECT_EQ(space["from"], space["fate"] == "filled") << space;
    }
}

TEST_F(Grid, SaysAsATableWhatItKeptAndDropped) {
    const std::string table =
        succeed({"grid", kCourtyard, "-o", "grid.json", "--spacing", "2"}).out;
    for (const char* words :
         {"grid.json: ", " candidates\n", "kept where it stood", "pushed, or taken to a wall",
          "added at walls", "free space:", "covered", "outside of the tetrahedra",
          "out of sight of probes", "to the nearest surface:", "from 4 m on"}) {
        EXPECT_TRUE(contains(table, words)) << words << "\n" << table;
    }
}

TEST_F(Grid, AGlbBakesToTheVolumeOfTheJson) {
    const Arguments common{"--spacing", "3", "--mode", "layers", "--region-size", "8"};
    for (const char* output : {"g.json", "g.glb"}) {
        Arguments arguments{"grid", kCourtyard, "-o", output};
        arguments.insert(arguments.end(), common.begin(), common.end());
        succeed(arguments);
        succeed({"bake", kCourtyard, "-g", output, "--only-given-groups", "-o",
                 std::string(output) + ".probes", "-s", "16"});
    }
    const Json json = run_json({"info", "g.json.probes"}), glb = run_json({"info", "g.glb.probes"});
    EXPECT_GT(json["groups"], 1);
    for (const char* count : {"probes", "groups", "welded"}) EXPECT_EQ(json[count], glb[count]);
}

TEST_F(Grid, KeepsAllSpacesWithoutAWordWhenAsked) {
    const CommandResult result =
        succeed({"grid", kCourtyard, "-o", "g.json", "--spacing", "2", "--min", "-10,-6,-10",
                 "--max", "10,8,10", "--unreachable", "keep", "--keep-dark"});
    EXPECT_EQ(result.err, "");
}

TEST_F(Grid, RefusesAPositionInAWallOrOutside) {
    const std::string message = fail_and_keep(
        "g.json", {"grid", kCourtyard, "-o", "g.json", "--spacing", "2", "--from", "0,900,0"});
    EXPECT_TRUE(contains(message, "seed 0,900,0 is outside of the bounds")) << message;
}

TEST_F(Grid, RefusesWhatDoesNotGoTogether) {
    const Arguments start{"grid", kCourtyard, "-o", "g.json"};
    const auto misuse_with = [&](Arguments more) {
        more.insert(more.begin(), start.begin(), start.end());
        return misuse(more);
    };
    EXPECT_TRUE(contains(misuse_with({}), "--spacing is required"));
    EXPECT_TRUE(contains(misuse_with({"--spacing", "1", "--heights", "1"}), "--heights"));
    EXPECT_TRUE(contains(misuse_with({"--spacing", "1", "--from", "1,2"}), "--from"));
    EXPECT_TRUE(contains(misuse_with({"--spacing", "1", "--clearance", "-1"}), "--clearance"));
    EXPECT_TRUE(
        contains(misuse_with({"--spacing", "1", "--agent-radius", "-1"}), "--agent-radius"));
    EXPECT_TRUE(contains(misuse_with({"--spacing", "1", "--mode", "best"}), "--mode"));
    EXPECT_TRUE(contains(misuse_with({"--mode", "adaptive", "--error", "small"}), "--error"));
}

TEST_F(Grid, RefusesNumbersThatAreNone) {
    const auto message = [&](const char* option, const char* value) {
        return misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "1", option, value});
    };
    EXPECT_TRUE(contains(message("--from", "nan,0,0"), "--from: \"nan\" is not a number"));
    EXPECT_TRUE(contains(message("--max-probes", "0"), "--max-probes"));
    EXPECT_TRUE(contains(misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "nan"}),
                         "--spacing: \"nan\" is not a number"));
}

TEST_F(Grid, StdoutTakesOneFile) {
    const std::string message =
        misuse({"grid", kCourtyard, "-o", "-", "--preview", "-", "--spacing", "4"});
    EXPECT_TRUE(contains(message, "--preview: stdout takes the probes already")) << message;
}

TEST_F(Grid, WritesTheReflectionProbesThatItReports) {
    const Arguments start{"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--reflections"};
    const auto with = [&](Arguments more) {
        more.insert(more.begin(), start.begin(), start.end());
        return more;
    };
    const Json report = run_json(with({"r.json", "--reflection-spacing", "6"}));
    EXPECT_EQ(report["reflections"], "r.json");
    const Json places = Json::parse(read("r.json"))["reflection_probes"];
    ASSERT_GT(places.size(), 1u);
    ASSERT_EQ(places.size(), report["reflection_probes"].size());
    for (size_t i = 0; i < places.size(); ++i) {
        const Json& listed = report["reflection_probes"][i];
        EXPECT_EQ(places[i]["name"], listed["name"]);
        for (size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(listed["size"][axis].get<double>(),
                        2.0 * places[i]["box"]["half_size"][axis].get<double>(), 1e-4);
        }
    }
    const std::string table = succeed(with({"r.glb", "--reflection-spacing", "6"})).out;
    const std::string first = "r.glb: " + std::to_string(places.size()) + " reflection probes\n";
    EXPECT_TRUE(contains(table, first)) << table;
    EXPECT_TRUE(contains(table, places[0]["name"].get<std::string>())) << table;
    EXPECT_TRUE(contains(read("r.glb"), "\"reflection_probe\":{\"size\":"));
    const Json far = run_json(with({"far.json"}));
    EXPECT_GT(far["reflection_probes"].size(), 0u);
    EXPECT_LT(far["reflection_probes"].size(), places.size());
}

TEST_F(Grid, SaysThatThereAreNoReflectionProbes) {
    write("empty.gltf", kEmptyScene);
    const std::string table =
        succeed({"grid", "empty.gltf", "-o", "g.json", "--spacing", "1", "--min", "0,0,0", "--max",
                 "3,3,3", "--sky", "1", "--reflections", "r.json"})
            .out;
    EXPECT_TRUE(contains(table, "r.json: no reflection probes; there is no room")) << table;
    EXPECT_EQ(Json::parse(read("r.json"))["reflection_probes"].size(), 0u);
}

TEST_F(Grid, RefusesReflectionProbesInTheWrongPlace) {
    const Arguments start{"grid", kCourtyard, "-o", "g.json", "--spacing", "4"};
    const auto with = [&](Arguments more) {
        more.insert(more.begin(), start.begin(), start.end());
        return more;
    };
    EXPECT_TRUE(contains(fail(with({"--reflections", "g.json"})), "is the output of this command"));
    EXPECT_TRUE(contains(misuse(with({"--reflections", "-"})), "is written to a file only"));
    EXPECT_TRUE(contains(misuse(with({"--reflections", "r.txt"})), "--reflections"));
    EXPECT_TRUE(contains(misuse(with({"--reflection-spacing", "4"})), "needs --reflections"));
    EXPECT_TRUE(contains(misuse(with({"--reflections", "r.json", "--reflection-spacing", "0"})),
                         "--reflection-spacing"));
}

TEST_F(Grid, SaysThatProbeGroupsAreNoScene) {
    write("groups.json", kFiveProbes);
    EXPECT_EQ(fail({"grid", "groups.json", "-o", "g.json", "--spacing", "4"}),
              "tetralight: groups.json: contains probe groups, not a scene\n");
}

TEST_F(Grid, NamesANavmeshThatIsMissingOrEmpty) {
    write("bare.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"name": "lamp"}]})");
    const auto message = [&](const char* navmesh) {
        return fail({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--navmesh", navmesh});
    };
    EXPECT_TRUE(contains(message("gone.glb"), "gone.glb: ")) << message("gone.glb");
    EXPECT_EQ(message("bare.gltf"), "tetralight: bare.gltf: contains no mesh to walk on\n");
}

TEST_F(Grid, RefusesAnAgentHeightWithoutAWalkableSurface) {
    const std::string message =
        fail({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--agent-height", "1.5"});
    EXPECT_TRUE(contains(message, "--agent-height: needs a walkable surface, from --navmesh or"))
        << message;
}

TEST_F(Grid, SaysThatThereIsNoNodeOfThatName) {
    const std::string message =
        fail({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--bounds-of", "the moon"});
    EXPECT_TRUE(contains(message, "there is no node \"the moon\"")) << message;
}

TEST_F(Grid, CtrlCLeavesTheOldFileAndSaysSo) {
    write("g.json", "old");
    RunningCommand grid(folder(), {"grid", kCourtyard, "-o", "g.json", "--spacing", "0.2"}, "");
    while (!grid.handles(SIGINT)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    grid.send(SIGINT);
    const CommandResult result = grid.wait();
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "tetralight: interrupted; g.json is as it was\n");
    EXPECT_EQ(read("g.json"), "old");
    EXPECT_EQ(file_names().size(), 1u);
}

TEST_F(Grid, NamesTheGroupAsAsked) {
    succeed({"grid", kCourtyard, "-o", "grid.json", "--spacing", "9", "--name", "the \"hall\""});
    EXPECT_EQ(Json::parse(read("grid.json"))["groups"][0]["name"], "the \"hall\"");
}

TEST_F(Grid, StaysInTheGivenBox) {
    succeed({"grid", kCourtyard, "-o", "grid.json", "--spacing", "1,0.5,2", "--min", "10,1,10",
             "--max", "14,2,14"});
    const Json positions = Json::parse(read("grid.json"))["groups"][0]["positions"];
    EXPECT_EQ(positions.size(), 4u * 2u * 2u);
    for (const Json& position : positions) {
        EXPECT_TRUE(position[0] >= 10 && position[0] <= 14) << position;
        EXPECT_TRUE(position[1] >= 1 && position[1] <= 2) << position;
        EXPECT_TRUE(position[2] >= 10 && position[2] <= 14) << position;
    }
}

TEST_F(Grid, GivesTheSameBytesForAnyNumberOfThreads) {
    succeed({"grid", kCourtyard, "-o", "one.json", "--spacing", "2", "-j", "1"});
    succeed({"grid", kCourtyard, "-o", "two.json", "--spacing", "2", "-j", "2"});
    EXPECT_TRUE(read("one.json") == read("two.json"));
}

TEST_F(Grid, RefusesSpacingsThatAreNoLengths) {
    for (const char* spacing : {"0", "-1", "nan", "inf", "abc", "1,2", "1,0,1", "1,2,3,4", ""}) {
        EXPECT_TRUE(contains(misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", spacing}),
                             "--spacing"));
    }
}

TEST_F(Grid, RefusesABoxThatIsTurnedInsideOut) {
    const std::string message = misuse(
        {"grid", kCourtyard, "-o", "g.json", "--spacing", "1", "--min", "0,2,0", "--max", "1,1,1"});
    EXPECT_TRUE(contains(message, "--max: 1 is less than --min 2 along y")) << message;
}

TEST_F(Grid, RefusesMoreProbesThanAllowed) {
    const std::string message = fail_and_keep(
        "g.json", {"grid", kCourtyard, "-o", "g.json", "--spacing", "1", "--max-probes", "100"});
    EXPECT_TRUE(contains(message, "more than the limit of 100")) << message;
}

TEST_F(Grid, RefusesBadScenesAndKeepsTheOldFile) {
    refuse_each(bad_scenes(read(kCourtyard)), "g.json", [](const std::string& name) {
        return Arguments{"grid", name, "-o", "g.json", "--spacing", "2"};
    });
}

TEST_F(Grid, RefusesASceneWithoutExtent) {
    write("empty.gltf", kEmptyScene);
    const std::string message =
        fail_and_keep("g.json", {"grid", "empty.gltf", "-o", "g.json", "--spacing", "2"});
    EXPECT_TRUE(contains(message, "empty.gltf: ")) << message;
}

TEST_F(Grid, CountsAgreeFromGridToValidate) {
    const Json grid = run_json({"grid", kCourtyard, "-o", "grid.json", "--spacing", "3"});
    const Json alone = run_json({"bake", kCourtyard, "-o", "alone.probes", "-s", "1"});
    const Json baked =
        run_json({"bake", kCourtyard, "-g", "grid.json", "-o", "v.probes", "-s", "16"});
    const Json info = run_json({"info", "v.probes"});
    const Json valid = run_json({"validate", "v.probes"});
    EXPECT_EQ(baked["probes"].get<int>() + baked["welded"].get<int>(),
              grid["probes"].get<int>() + alone["probes"].get<int>());
    for (const char* count : {"probes", "inner_cells", "hull_cells", "groups", "welded"}) {
        EXPECT_EQ(info[count], baked[count]) << count;
        EXPECT_EQ(valid[count], baked[count]) << count;
    }
    EXPECT_EQ(valid["is_valid"], true);
}

}  // namespace
}  // namespace tetralight::test
