// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Tetrahedralize : public CommandFixture {
  protected:
    Tetrahedralize() { write("five.json", kFiveProbes); }
};

TEST_F(Tetrahedralize, JoinsTheProbesOfAGroupFile) {
    const Json json = run_json({"tetrahedralize", "five.json", "-o", "v.probes"});
    // The fifth probe splits the tetrahedron of the others in four.
    EXPECT_EQ(json["probes"], 5);
    EXPECT_EQ(json["inner_cells"], 4);
    EXPECT_EQ(json["hull_cells"], 4);
}

TEST_F(Tetrahedralize, JoinsTheGroupsOfAScene) {
    const Json json = run_json({"tetrahedralize", kCourtyard, "-o", "v.probes"});
    EXPECT_EQ(json["probes"], 255);
    EXPECT_EQ(json["groups"], 5);
}

TEST_F(Tetrahedralize, GivesTheSameBytesForAnyOrderOfFiles) {
    succeed({"tetrahedralize", kCourtyard, "five.json", "-o", "a.probes"});
    succeed({"tetrahedralize", "five.json", kCourtyard, "-o", "b.probes"});
    EXPECT_TRUE(read("a.probes") == read("b.probes"));
}

TEST_F(Tetrahedralize, MakesTheVolumeThatABakeMakes) {
    const Json joined = run_json({"tetrahedralize", kCourtyard, "-o", "v.probes"});
    const Json baked = run_json({"bake", kCourtyard, "-o", "b.probes", "-s", "1"});
    for (const char* count : {"probes", "inner_cells", "hull_cells", "groups", "welded"}) {
        EXPECT_EQ(joined[count], baked[count]) << count;
    }
}

TEST_F(Tetrahedralize, WeldsProbesThatAreNear) {
    write("twice.json", R"({"groups": [{"name": "twice", "positions":
        [[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8], [8, 0, 0.001]]}]})");
    const Json json =
        run_json({"tetrahedralize", "twice.json", "-o", "v.probes", "--weld", "0.001"});
    EXPECT_EQ(json["probes"], 4);
    EXPECT_EQ(json["welded"], 1);
}

TEST_F(Tetrahedralize, SaysWhichGroupsAreLattices) {
    // 2 × 2 × 2 probes 0.1 m apart, rounded as a file of floats has them.
    write("grid.json", R"({"groups": [{"name": "grid", "positions":
        [[0, 0, 0], [0.10000000149, 0, 0], [0, 0.1, 0], [0.1, 0.1, 0],
         [0, 0, 0.1], [0.1, 0, 0.1], [0, 0.1, 0.1], [0.1, 0.1, 0.1]]}]})");
    const Json json = run_json({"tetrahedralize", "grid.json", "five.json", "-o", "v.probes"});
    EXPECT_EQ(json["lattice_groups"], Json{"grid"});
    EXPECT_GT(json["largest_snap"], 0.0);
    EXPECT_LT(json["largest_snap"], 1e-7);
    const std::string out =
        succeed({"tetrahedralize", "grid.json", "five.json", "-o", "v.probes"}).out;
    EXPECT_TRUE(contains(out, " welded, 1 lattice snapped by up to ")) << out;
    const Json none = run_json({"tetrahedralize", "five.json", "-o", "v.probes"});
    EXPECT_EQ(none["lattice_groups"], Json::array());
}

TEST_F(Tetrahedralize, MakesTrianglesOfAFlatSet) {
    write("flat.json", R"({"groups": [{"name": "flat", "positions":
        [[0, 1, 0], [4, 1, 0], [0, 1, 4], [4, 1, 4], [1, 1, 2]]}]})");
    const Json json = run_json({"tetrahedralize", "flat.json", "-o", "v.probes"});
    EXPECT_EQ(json["dimension"], "plane");
    EXPECT_EQ(json["inner_cells"], 4);  // a fan around the inner probe
    EXPECT_TRUE(contains(succeed({"validate", "v.probes"}).out, "4 triangles"));
}

TEST_F(Tetrahedralize, CountsOneProbeAsOne) {
    write("one.json", R"({"groups": [{"name": "one", "positions": [[0, 1, 0]]}]})");
    const std::string out = succeed({"tetrahedralize", "one.json", "-o", "v.probes"}).out;
    EXPECT_EQ(out, "v.probes: 1 probe (0 welded), 1 cell, no light\n");
}

TEST_F(Tetrahedralize, LeavesGroupsWithoutProbesOutAndSaysSo) {
    write("empty.json", R"({"groups": [{"name": "hall", "positions": []}]})");
    const CommandResult result =
        succeed({"tetrahedralize", "five.json", "empty.json", "-o", "v.probes"});
    EXPECT_EQ(result.err, "warning: empty.json: group \"hall\" has no probes\n");
    EXPECT_EQ(run_json({"info", "v.probes"})["probes"], 5);
}

TEST_F(Tetrahedralize, MakesAnEmptyVolumeOfNoProbes) {
    write("none.json", R"({"groups": []})");
    write("empty.json", R"({"groups": [{"name": "hall", "positions": []}]})");
    for (const char* groups : {"none.json", "empty.json"}) {
        const CommandResult result = succeed({"tetrahedralize", groups, "-o", "v.probes"});
        EXPECT_TRUE(contains(result.err, "warning: there are no probes: the volume answers"));
        succeed({"validate", "v.probes"});
        EXPECT_EQ(run_json({"info", "v.probes"})["dimension"], "none");
        EXPECT_EQ(succeed({"query", "v.probes"}, "1 2 3").out, "1 2 3: ambient\n");
    }
}

TEST_F(Tetrahedralize, WarnsOfASetThatCountsAsFlat) {
    // A tenth of a millimetre thick, and 1e-4 of the spacing is a millimetre.
    write("thin.json", R"({"groups": [{"name": "thin", "positions":
        [[0, 0, 0], [10, 0, 0], [0, 0, 10], [10, 1e-4, 10]]}]})");
    const CommandResult result = succeed({"tetrahedralize", "thin.json", "-o", "v.probes"});
    EXPECT_EQ(result.err.find("warning: 4 probes lie in one plane (thinner than "), 0u)
        << result.err;
    EXPECT_EQ(run_json({"info", "v.probes"})["dimension"], "plane");
}

TEST_F(Tetrahedralize, SaysWhatIsNoGroupFile) {
    succeed({"tetrahedralize", "five.json", "-o", "v.probes"});
    EXPECT_TRUE(contains(fail({"tetrahedralize", "v.probes", "-o", "w.probes"}),
                         "v.probes: is a probe volume, not a group file"));
}

TEST_F(Tetrahedralize, RefusesToWriteOverItsInput) {
    write("groups", kFiveProbes);
    const std::string message = fail({"tetrahedralize", "groups", "-o", "./groups"});
    EXPECT_TRUE(contains(message, "is an input of this command")) << message;
    EXPECT_EQ(read("groups"), kFiveProbes);
}

TEST_F(Tetrahedralize, NamesTheFileOfAPositionThatIsTooFar) {
    write("far.json", R"({"groups": [{"name": "far", "positions": [[0, 0, 0], [1e19, 0, 0]]}]})");
    const std::string message = fail_and_keep(
        "old.probes", {"tetrahedralize", "five.json", "far.json", "-o", "old.probes"});
    EXPECT_TRUE(contains(message, "far.json: group \"far\": probe 1: position")) << message;
}

TEST_F(Tetrahedralize, NamesAGroupThatIsThereTwice) {
    const std::string message = fail_and_keep(
        "old.probes", {"tetrahedralize", "five.json", "five.json", "-o", "old.probes"});
    EXPECT_TRUE(contains(message, "five.json: group \"five\": there are two")) << message;
}

TEST_F(Tetrahedralize, KeepsToOneLineWhenANameHasTwo) {
    write("lines.json", R"({"groups": [{"name": "two\nlines", "positions": [[0, 0, 0]]}]})");
    const std::string message = fail({"tetrahedralize", "lines.json", "-o", "v.probes"});
    EXPECT_TRUE(contains(message, "group \"two\\u000alines\"")) << message;
}

TEST_F(Tetrahedralize, RefusesBadGroupsAndKeepsTheOldVolume) {
    refuse_each(bad_groups(), "old.probes", [](const std::string& name) {
        return Arguments{"tetrahedralize", "five.json", name, "-o", "old.probes"};
    });
}

TEST_F(Tetrahedralize, RefusesBadScenesAndKeepsTheOldVolume) {
    refuse_each(bad_scenes(read(kCourtyard)), "old.probes", [](const std::string& name) {
        return Arguments{"tetrahedralize", name, "-o", "old.probes"};
    });
}

TEST_F(Tetrahedralize, NamesAFileThatIsNotThere) {
    EXPECT_TRUE(contains(fail({"tetrahedralize", "none.json", "-o", "v.probes"}),
                         "none.json: cannot open"));
}

}  // namespace
}  // namespace tetralight::test
