// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class LppvCommand : public CommandFixture {
  protected:
    LppvCommand() { bake_courtyard("v.probes"); }

    [[nodiscard]] static Arguments arguments(const std::string& output, Arguments more) {
        Arguments all{"lppv", "v.probes", "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    [[nodiscard]] static Arguments beam(const std::string& output, Arguments more = {}) {
        more.insert(more.end(), {"--scene", kCourtyard, "--object", "beam_long"});
        return arguments(output, more);
    }
};

TEST_F(LppvCommand, WrapsAnObjectOfTheScene) {
    const Json json = run_json(beam("beam.vdb", {"--density", "2"}));
    EXPECT_EQ(json["resolution"], Json({1, 1, 20}));  // 0.6 x 0.6 x 10 m
    EXPECT_NEAR(json["spacing"][2].get<double>(), 10.0 / 19.0, 1e-9);
    EXPECT_EQ(json["points"], 20);
    EXPECT_EQ(json["bounds"]["world_from_local"].size(), 16u);
    EXPECT_NEAR(json["bounds"]["high"][2].get<double>(), 5.0, 1e-6);
    EXPECT_EQ(json["bytes"], read("beam.vdb").size());
    EXPECT_TRUE(json.contains("fill_seconds"));
}

TEST_F(LppvCommand, WritesEveryKindOfFile) {
    for (const std::string kind : {"vdb", "nvdb", "exr", "dds", "ktx2"}) {
        succeed(beam("a." + kind, {"--resolution", "2,2,16"}));
        EXPECT_GT(read("a." + kind).size(), 64u * 27u * 2u) << kind;
    }
    EXPECT_EQ(read("a.dds").substr(0, 4), "DDS ");
    EXPECT_EQ(read("a.ktx2").substr(1, 6), "KTX 20");
    // Seven slabs of eight bytes a point.
    EXPECT_EQ(read("a.dds").size(), 148u + 7u * 64u * 8u);
}

TEST_F(LppvCommand, GivesTheConstantsOfTextures) {
    const Json json =
        run_json(beam("a.ktx2", {"--mode", "normal", "--resolution", "2", "2", "16"}));
    EXPECT_EQ(json["constants"]["layout"], "four slabs");
    EXPECT_NEAR(json["constants"]["params"][2].get<double>(), 1.0 / 8.0, 1e-6);
    EXPECT_TRUE(contains(read("a.ktx2"), "local_from_world"));
}

TEST_F(LppvCommand, FillsABoxOfTheWorldOrThatOfTheProbes) {
    const Json box = run_json(arguments("a.vdb", {"--bounds", "-1,0,-1,3,2,1", "--density", "1"}));
    EXPECT_EQ(box["resolution"], Json({4, 2, 2}));
    const Json probes = run_json(arguments("a.vdb", {"--density", "0.5"}));
    EXPECT_GT(probes["points"], 1000);
    EXPECT_EQ(probes["replaced"], 0);
}

TEST_F(LppvCommand, PointsInGeometryTakeTheLightBeside) {
    const Json json = run_json(arguments("a.vdb", {"--density", "0.5", "--scene", kCourtyard}));
    EXPECT_GT(json["replaced"], 0);
}

TEST_F(LppvCommand, RoundsAsUnityDoes) {
    const Json json = run_json(beam("a.vdb", {"--density", "2", "--unity-limits"}));
    EXPECT_EQ(json["resolution"], Json({1, 1, 16}));
}

TEST_F(LppvCommand, SparseFilesHoldWhatIsNearProbesAndSurfaces) {
    const Json all =
        run_json(arguments("a.vdb", {"--sparse", "--density", "1", "--scene", kCourtyard}));
    const Json probes = run_json(arguments("b.nvdb", {"--sparse", "--density", "1"}));
    EXPECT_GT(all["blocks"], probes["blocks"]);
    EXPECT_GT(probes["blocks"], 10);
    EXPECT_EQ(all["points"], 512 * all["blocks"].get<int>());
}

TEST_F(LppvCommand, RefusesWhatDoesNotGoTogether) {
    EXPECT_TRUE(contains(misuse(arguments("a.exr", {"--sparse"})), "can be sparse"));
    EXPECT_TRUE(contains(misuse(arguments("a.nvdb", {"--precision", "half"})), "have floats"));
    misuse(arguments("a.vdb", {"--object", "beam_long"}));
    misuse(arguments("a.vdb", {"--bounds", "0,0,0,1,1"}));
    misuse(arguments("a.vdb", {"--resolution", "2,2,2", "--density", "1"}));
    misuse(arguments("a.vdb", {"--sparse", "--mode", "low"}));
}

TEST_F(LppvCommand, SaysWhatIsWrongWithABox) {
    EXPECT_TRUE(contains(fail_and_keep("a.vdb", arguments("a.vdb", {"--bounds", "2,0,0,1,1,1"})),
                         "bounds are reversed along x: 2 to 1"));
    EXPECT_TRUE(contains(fail(arguments("a.vdb", {"--bounds", "nan,0,0,1,1,1"})),
                         "bounds are not finite along x: nan to 1"));
    EXPECT_TRUE(contains(fail(arguments("a.vdb", {"--resolution", "10000,1000,1000"})),
                         "10000 x 1000 x 1000 points (1e+10 in all) is too large"));
    EXPECT_TRUE(
        contains(fail(arguments("a.vdb", {"--sparse", "--density", "1000", "--scene", kCourtyard})),
                 "a sparse grid of"));
}

TEST_F(LppvCommand, NamesAnObjectThatIsNotThere) {
    EXPECT_TRUE(contains(fail(arguments("a.vdb", {"--scene", kCourtyard, "--object", "boat"})),
                         "courtyard.glb: there is no node \"boat\""));
}

}  // namespace
}  // namespace tetralight::test
