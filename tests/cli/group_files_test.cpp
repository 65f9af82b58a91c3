// SPDX-License-Identifier: Apache-2.0
// Probe groups of other programs, by --groups: the files of tests/imports/files.
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

const std::string kFiles = TETRALIGHT_IMPORT_FILES "/";

class GroupFiles : public CommandFixture {
  protected:
    /// The names of the groups of a volume.
    [[nodiscard]] std::vector<std::string> group_names(const std::string& volume) const {
        std::vector<std::string> names;
        const Json info = run_json({"info", volume});
        for (const Json& group : info["group_list"]) names.push_back(group["name"]);
        return names;
    }
};

TEST_F(GroupFiles, KeepTheNamesOfObjects) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> expected = {
        {"probes.csv", {"hall, ground floor", "tower"}},
        {"level.tscn", {"Level", "Level/Hall", "Level/Lamp"}},
        {"level.unity", {"Level/Hall", "Level/Tower: \"top\""}}};
    for (const auto& [file, names] : expected) {
        const Json json = run_json({"tetrahedralize", kFiles + file, "-o", "v.probes"});
        EXPECT_EQ(json["probes"], 5) << file;
        EXPECT_EQ(group_names("v.probes"), names);
    }
}

TEST_F(GroupFiles, MakeTheVolumeOfTheSamePositionsAsJson) {
    write("same.json", R"({"groups": [{"name": "a", "positions":
        [[0, 0.5, 0], [8, 0.5, 0], [0, 0.5, 8], [0, 8.5, 0], [1, 1.5, 1]]}]})");
    const Json json = run_json({"tetrahedralize", "same.json", "-o", "v.probes"});
    const Json csv = run_json({"tetrahedralize", kFiles + "probes.csv", "-o", "w.probes"});
    for (const char* count : {"probes", "inner_cells", "hull_cells", "dimension"})
        EXPECT_EQ(csv[count], json[count]) << count;
}

TEST_F(GroupFiles, AreBakedWithTheirWarnings) {
    write("empty.gltf", kEmptyScene);
    const CommandResult result = succeed({"bake", "empty.gltf", "-g", kFiles + "level.tscn", "-g",
                                          kFiles + "probes.csv", "-s", "1", "-o", "v.probes"});
    EXPECT_TRUE(contains(result.err, "warning: " + kFiles + "level.tscn: 1 instanced scene is not"))
        << result.err;
    EXPECT_TRUE(contains(result.err, "probes.csv: columns other than x, y, z and group"));
    // Both files have the same five positions.
    EXPECT_EQ(run_json({"info", "v.probes"})["probes"], 5);
    EXPECT_EQ(group_names("v.probes").size(), 5u);
}

TEST_F(GroupFiles, AreRefusedWithLineAndValueAndKeepTheOldVolume) {
    write("bad.csv", "1,2,3\n1,2,three\n");
    const std::string message =
        fail_and_keep("old.probes", {"tetrahedralize", "bad.csv", "-o", "old.probes"});
    EXPECT_TRUE(contains(message, "bad.csv:2: z is not a number (\"three\")")) << message;
    write("empty.gltf", kEmptyScene);
    write("bad.tscn",
          "[gd_scene format=3]\n[node name=\"P\" type=\"LightmapProbe\" parent=\"Q\"]\n");
    const std::string of_bake =
        fail_and_keep("old.probes", {"bake", "empty.gltf", "-g", "bad.tscn", "-o", "old.probes"});
    EXPECT_TRUE(contains(of_bake, "bad.tscn:2: node \"P\": its parent \"Q\"")) << of_bake;
}

TEST_F(GroupFiles, NameTheFileOfANameWithTwoLines) {
    write("lines.csv", "1,2,3,\"two\nlines\"\n");
    const std::string message = fail({"tetrahedralize", "lines.csv", "-o", "v.probes"});
    EXPECT_TRUE(contains(message, "lines.csv: group \"two\\u000alines\"")) << message;
}

}  // namespace
}  // namespace tetralight::test
