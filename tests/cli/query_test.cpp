// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/probe_file.h>
#include "tests/cli/query_fixture.h"

namespace tetralight::test {
namespace {

class Query : public QueryFixture {};

double weight_sum(const Json& answer) {
    double sum = 0.0;
    for (const Json& probe : answer["probes"]) sum += probe["weight"].get<double>();
    return sum;
}

TEST_F(Query, AnswersOneJsonObjectALine) {
    const auto all = answers("1 1 1\n2 1 1\n");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1]["position"], (Json{2.0, 1.0, 1.0}));
    EXPECT_EQ(all[1]["irradiance_sh"].size(), 9u);
    EXPECT_EQ(all[1]["occlusion"].size(), 4u);
    EXPECT_NEAR(weight_sum(all[1]), 1.0, 1e-6);
}

TEST_F(Query, AnswersOneLineOfTextAPosition) {
    const std::string out = succeed({"query", "v.probes"}, "1 1 2\n-5 1 1\n").out;
    EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 2) << out;
    EXPECT_EQ(out.find("1 1 2: tetrahedron "), 0u) << out;
    EXPECT_TRUE(contains(out, "\n-5 1 1: hull cell ")) << out;
}

TEST_F(Query, CallsTheCellsOfFlatVolumesByTheirNames) {
    for (const auto& [positions, name] :
         {std::pair<std::string, std::string>("[0, 0, 0], [8, 0, 0], [0, 0, 8]", "triangle"),
          {"[0, 0, 0], [8, 0, 0]", "segment"},
          {"[0, 0, 0]", "cell"}}) {
        write("flat.json", R"({"groups": [{"name": "a", "positions": [)" + positions + "]}]}");
        succeed({"tetrahedralize", "flat.json", "-o", "flat.probes"});
        const std::string out = succeed({"query", "flat.probes"}, "1 0 1").out;
        EXPECT_EQ(out.find("1 0 1: " + name + " 0, probes "), 0u) << out;
    }
}

TEST_F(Query, AnswersAFileAsItAnswersStdin) {
    write("positions.txt", "1 1 1\n2 1 1\n");
    EXPECT_EQ(succeed({"query", "v.probes", "positions.txt"}).out,
              succeed({"query", "v.probes", "-"}, "1 1 1\n2 1 1\n").out);
}

TEST_F(Query, SkipsCommentsAndBlankLines) {
    const auto all = answers("# a comment\n\n  \t\n1 1 1 # here\r\n\t1,1 , 2\n1 2 3");
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0]["position"], (Json{1.0, 1.0, 1.0}));
    EXPECT_EQ(all[1]["position"], (Json{1.0, 1.0, 2.0}));
    EXPECT_EQ(all[2]["position"], (Json{1.0, 2.0, 3.0}));
}

TEST_F(Query, AnswersNothingToNothing) {
    EXPECT_EQ(succeed({"query", "v.probes"}, "").out, "");
}

TEST_F(Query, NamesTheFileAndTheLineThatIsMalformed) {
    for (const char* line : {"1 2", "1 2 3 4", "one two three", "1 2 3x", "1;2;3"}) {
        write("positions.txt", std::string("# three numbers\n\n") + line + "\n");
        const std::string message = fail({"query", "v.probes", "positions.txt"});
        EXPECT_TRUE(contains(message, std::string("positions.txt:3: \"") + line)) << message;
    }
}

TEST_F(Query, NamesStdinWhenItsLineIsMalformed) {
    const std::string message = fail({"query", "v.probes"}, "1 2\n");
    EXPECT_TRUE(contains(message, "stdin:1: \"1 2\"")) << message;
}

TEST_F(Query, NamesTheLineAndTheNumberThatNoFloatHolds) {
    const std::string large = fail({"query", "v.probes"}, "# 1e39\n\n0 -1e39 0\n");
    EXPECT_TRUE(contains(large, "stdin:3: y is -1e39, beyond what a float holds")) << large;
    const std::string huge = fail({"query", "v.probes"}, "0 0 1e999\n");
    EXPECT_TRUE(contains(huge, "stdin:1: z is 1e999, beyond")) << huge;
}

TEST_F(Query, TakesNumbersBelowAllFloatsForZero) {
    const auto all = answers("1e-60 1e-999 -1e-60\n0 0 0\n");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0]["probes"], all[1]["probes"]);
}

TEST_F(Query, WarnsOfAVolumeWithoutLight) {
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    const CommandResult result = succeed({"query", "unlit.probes"}, "1 1 1\n");
    EXPECT_EQ(result.err.find("warning: unlit.probes: the volume holds no light"), 0u);
}

TEST_F(Query, ShowsOfABinaryLineOnlyWhatATerminalCanTake) {
    write("binary", "\x1b[31m\x07" + std::string(5000, '\x80'));
    const std::string message = fail({"query", "v.probes", "binary"});
    EXPECT_LT(message.size(), 120u);
    EXPECT_EQ(message.find('\x1b'), std::string::npos);
}

TEST_F(Query, NamesPositionsThatAreNotThere) {
    EXPECT_TRUE(contains(fail({"query", "v.probes", "none.txt"}), "none.txt: cannot open"));
    EXPECT_TRUE(contains(fail({"query", "v.probes", "."}), ".: cannot read"));
}

TEST_F(Query, GivesAProbeAllWeightAtItsPosition) {
    const auto all = answers("1 1 1\n");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file && all.size() == 1);
    int found = 0;
    for (const Json& probe : all[0]["probes"]) {
        if (probe["weight"].get<double>() != 1.0) continue;
        ++found;
        EXPECT_EQ(file->view().exact_positions[probe["probe"].get<size_t>()], glm::dvec3(1.0));
    }
    EXPECT_EQ(found, 1);
}

TEST_F(Query, HidesProbesBehindWallsOnRequestOnly) {
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    ProbeVolume volume = copy_volume(file->view());
    const ProbeEdges edges(volume.view());
    std::vector<uint8_t> codes(edges.size(), kFreeEdge);
    for (size_t i = 0; i < codes.size(); i += 2) codes[i] = 255;  // blocked beside the probe
    store_visibility(edges, codes, volume);
    ASSERT_TRUE(write_probe_file(path("walls.probes"), volume.view()));
    const std::string position = "1.25 1.5 1.75\n";
    const auto ask = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"query", "walls.probes", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return Json::parse(succeed(arguments, position).out);
    };
    const Json plain = answers(position, {"--walls", "ignore"})[0];
    EXPECT_EQ(ask({"--walls", "ignore"}), plain);
    const Json hidden = ask({});
    EXPECT_NE(hidden["probes"], plain["probes"]);
    EXPECT_NEAR(weight_sum(hidden), 1.0, 1e-6);
    double light = 0.0;
    for (const Json& probe : hidden["probes"]) {
        light += probe["weight"].get<double>() *
                 double{volume.irradiance[probe["probe"].get<size_t>()].coefficients[0].x};
    }
    EXPECT_NEAR(hidden["irradiance_sh"][0][0].get<double>(), light, 1e-5 * light);
}

TEST_F(Query, StaysFiniteFarOutside) {
    for (const Json& answer : answers("1e6 2e6 -3e6\n0 -1e20 0\n3e38 3e38 3e38\n")) {
        EXPECT_NEAR(weight_sum(answer), 1.0, 1e-6) << answer;
        for (const Json& rgb : answer["irradiance_sh"]) {
            for (const Json& value : rgb) EXPECT_TRUE(value.is_number()) << answer;
        }
    }
}

TEST_F(Query, AnswersANonFinitePositionWithAmbientLight) {
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    const glm::vec3 ambient = file->view().info.ambient.coefficients[0];
    for (const Json& answer : answers("nan 0 0\n0 inf 0\n0 0 -inf\n")) {
        EXPECT_TRUE(answer["cell"].is_null()) << answer;
        EXPECT_EQ(answer["probes"], Json::array());
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(answer["irradiance_sh"][0][static_cast<size_t>(k)].get<float>(), ambient[k]);
        }
    }
    EXPECT_EQ(succeed({"query", "v.probes"}, "nan 0 0").out, "nan 0 0: ambient\n");
}

TEST_F(Query, RefusesBadVolumes) {
    refuse_each(bad_volumes(read("v.probes")), "", [](const std::string& name) {
        return Arguments{"query", name};
    });
}

}  // namespace
}  // namespace tetralight::test
