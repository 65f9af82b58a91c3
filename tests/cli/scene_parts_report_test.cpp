// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_parts_report.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include <tetralight/cli/table.h>

namespace tetralight::test {
namespace {

using cli::parts_json;
using cli::parts_text;
using cli::warnings_beside_parts;
using settings::Json;

ScenePart ignored_glass() {
    ScenePart part;
    part.use = PartUse::Ignored;
    part.name = "KHR_materials_volume";
    part.count = 10;
    part.elements = {"material 0 \"pane\"", "material 4 \"jar\""};
    part.note = "light that shines through is not absorbed";
    part.remedy = "model the absorption by the base color";
    part.changes_light = true;
    return part;
}

ScenePart read_triangles() {
    ScenePart part;
    part.name = "triangles";
    part.count = 1234567;
    return part;
}

ScenePart approximated_coat() {
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "KHR_materials_clearcoat";
    part.count = 1;
    part.note = "reflects diffusely as without the coat";
    return part;
}

const std::vector<ScenePart> kMixed{ignored_glass(), approximated_coat(), read_triangles()};

size_t characters(const std::string& line) {
    return static_cast<size_t>(std::ranges::count_if(
        line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(PartsJson, HasTheRowsInOrderOfTheirUse) {
    const Json rows = parts_json(kMixed);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["name"], "triangles");
    EXPECT_EQ(rows[1]["name"], "KHR_materials_clearcoat");
    EXPECT_EQ(rows[2]["name"], "KHR_materials_volume");
}

TEST(PartsJson, HasEveryMemberOfARow) {
    EXPECT_EQ(parts_json({ignored_glass()}),
              Json::parse(R"([{"use": "ignored", "name": "KHR_materials_volume", "count": 10,
                  "elements": ["material 0 \"pane\"", "material 4 \"jar\""],
                  "note": "light that shines through is not absorbed",
                  "remedy": "model the absorption by the base color", "changes_light": true}])"));
    EXPECT_EQ(parts_json({}), Json::array());
}

TEST(PartsText, AlignsRowsAndPutsNotesAndRemediesBelow) {
    EXPECT_EQ(parts_text(kMixed),
              "what was read\n"
              "  part                         count  use\n"
              "  triangles                1 234 567  read\n"
              "  KHR_materials_clearcoat          1  approximated\n"
              "      reflects diffusely as without the coat\n"
              "  KHR_materials_volume            10  ignored, changes the light\n"
              "      material 0 \"pane\", material 4 \"jar\" and 8 more: light that shines through "
              "is not absorbed\n"
              "      Remedy: model the absorption by the base color\n");
    EXPECT_EQ(parts_text({}), "");
}

TEST(PartsText, MarksOnlyPartsThatAreNotReadAndChangeTheLight) {
    ScenePart part = read_triangles();
    part.changes_light = true;
    EXPECT_EQ(parts_text({part}).find("changes the light"), std::string::npos);
    part.use = PartUse::Approximated;
    EXPECT_NE(parts_text({part}).find("approximated, changes the light"), std::string::npos);
    part.changes_light = false;
    EXPECT_EQ(parts_text({part}).find("changes the light"), std::string::npos);
}

TEST(PartsText, StaysWithin96ColumnsAndKeepsAllWords) {
    ScenePart part = ignored_glass();
    part.name = "misspelt extras \"" + std::string(200, 'x') + "\"";
    part.elements.assign(ScenePart::kMaxElements,
                         "node 1234567 \"a \xc3\xa9\xc3\xa9\xc3\xa9 gate\"");
    part.remedy.clear();
    for (int i = 0; i < 60; ++i) part.remedy += "word" + std::to_string(i) + " ";
    const std::string text = parts_text({part, read_triangles()});
    for (const std::string& line : lines_of(text)) EXPECT_LE(characters(line), 96u) << line;
    for (int i = 0; i < 60; ++i)
        EXPECT_NE(text.find(" word" + std::to_string(i)), std::string::npos) << i;
    EXPECT_NE(text.find("\xe2\x80\xa6"), std::string::npos) << text;
}

TEST(PartsText, ShowsNoControlCharactersOfTheFile) {
    ScenePart part = ignored_glass();
    part.name = "a\x1b[31m";
    part.elements = {"node 0 \"b\nc\""};
    const std::string text = parts_text({part});
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_NE(text.find("\"b\\u000ac\""), std::string::npos) << text;
}

TEST(WarningsBesideParts, LeavesOutThoseOfTheTable) {
    Scene scene;
    scene.parts = kMixed;
    const std::string other = "s.glb: mesh 2: 3 triangles without area are skipped";
    const std::string coat =
        "s.glb: KHR_materials_clearcoat: reflects diffusely as without the coat";
    scene.warnings = {other,
                      "s.glb: KHR_materials_volume (material 0 \"pane\" and 9 more): light that "
                      "shines through is not absorbed; model the absorption by the base color",
                      coat};
    // The coat changes no light: a reader warns of it for another reason.
    EXPECT_EQ(warnings_beside_parts(scene), (std::vector<std::string>{other, coat}));
}

TEST(Shortened, CutsBetweenCharacters) {
    EXPECT_EQ(cli::shortened("abc", 3), "abc");
    EXPECT_EQ(cli::shortened("abcd", 3), "ab\xe2\x80\xa6");
    EXPECT_EQ(cli::shortened("\xc3\xa9\xc3\xa9\xc3\xa9", 3), "\xc3\xa9\xc3\xa9\xc3\xa9");
    EXPECT_EQ(cli::shortened("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", 3),
              "\xc3\xa9\xc3\xa9\xe2\x80\xa6");
}

}  // namespace
}  // namespace tetralight::test
