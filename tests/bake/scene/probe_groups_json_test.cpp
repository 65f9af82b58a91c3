// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// Message of the error for a file's text, from behind the folder's name.
std::string error_of(std::string_view text) {
    const TempFolder folder;
    const auto groups = read_probe_groups(folder.write("groups.json", text));
    if (groups) return "(no error)";
    const std::string& message = error_text(groups.error());
    return message.substr(std::min(message.find("groups.json"), message.size()));
}

/// A file with one good group and a second one with this text after its name.
std::string hall_with(const std::string& rest) {
    return R"({"groups": [{"name": "yard", "positions": [[1, 2, 3]]}, {"name": "hall", )" + rest +
           "}]}";
}

bool is_same_bits(const glm::dvec3& a, const glm::dvec3& b) {
    for (int i = 0; i < 3; ++i) {
        if (std::bit_cast<uint64_t>(a[i]) != std::bit_cast<uint64_t>(b[i])) return false;
    }
    return true;
}

ProbeGroup one_probe(glm::dvec3 position) {
    return {"hall", glm::dmat4(1.0), {position}, false};
}

TEST(ProbeGroupsJson, ReadsWhatIsWritten) {
    const TempFolder folder;
    glm::dmat4 transform(2.0);
    transform[3] = {0.1, -7.0, 1e-9, 1.0};
    const std::vector<ProbeGroup> groups = {
        {"hall \"A\"\n\xc3\xa4", transform, {{0.1, 0.2, 0.3}, {-4.0, 5.5, 1e300}}, true},
        {"yard", glm::dmat4(1.0), {{1.0, 2.0, 3.0}}, false, 0x80000009}};
    ASSERT_TRUE(write_probe_groups(folder.path("g.json"), groups));
    const auto read = read_probe_groups(folder.path("g.json"));
    ASSERT_TRUE(read) << error_text(read.error());
    EXPECT_EQ(*read, groups);
}

TEST(ProbeGroupsJson, EveryFiniteDoubleComesBackBitForBit) {
    rc::check([](uint64_t x, uint64_t y, uint64_t z) {
        const glm::dvec3 position(std::bit_cast<double>(x), std::bit_cast<double>(y),
                                  std::bit_cast<double>(z));
        RC_PRE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
        const TempFolder folder;
        const std::vector<ProbeGroup> groups = {one_probe(position)};
        RC_ASSERT(static_cast<bool>(write_probe_groups(folder.path("g.json"), groups)));
        const auto read = read_probe_groups(folder.path("g.json"));
        RC_ASSERT(static_cast<bool>(read));
        RC_ASSERT(is_same_bits((*read)[0].positions[0], position));
    });
}

TEST(ProbeGroupsJson, OddDoublesComeBackBitForBit) {
    const TempFolder folder;
    const std::vector<ProbeGroup> groups = {{"hall",
                                             glm::dmat4(1.0),
                                             {{-0.0, 0.0, 5e-324},
                                              {1e22, 123456789012345680.0, -1e19},
                                              {1.7976931348623157e308, 1e15, 0.1}},
                                             false}};
    ASSERT_TRUE(write_probe_groups(folder.path("g.json"), groups));
    const auto read = read_probe_groups(folder.path("g.json"));
    ASSERT_TRUE(read) << error_text(read.error());
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(is_same_bits((*read)[0].positions[i], groups[0].positions[i])) << i;
    }
}

TEST(ProbeGroupsJson, WritesOneProbeALine) {
    const TempFolder folder;
    const std::vector<ProbeGroup> groups = {
        {"hall", glm::dmat4(1.0), {{1, 2, 3}, {0.5, 5, 6}}, false}};
    ASSERT_TRUE(write_probe_groups(folder.path("g.json"), groups));
    const auto bytes = *read_file(folder.path("g.json"));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_NE(text.find("\n        [1, 2, 3],\n        [0.5, 5, 6]\n"), std::string::npos) << text;
}

TEST(ProbeGroupsJson, TransformIsColumnMajor) {
    const TempFolder folder;
    const auto path =
        folder.write("g.json", hall_with(R"("transform": [1,0,0,0, 0,1,0,0, 0,0,1,0, 7,8,9,1],
                                "positions": [[0, 0, 0]])"));
    const auto groups = read_probe_groups(path);
    ASSERT_TRUE(groups) << error_text(groups.error());
    EXPECT_EQ((*groups)[1].world_from_group[3], glm::dvec4(7, 8, 9, 1));
}

struct Rejection {
    const char* label;
    std::string text;
    const char* error;
};

class ProbeGroupsJsonRejects : public testing::TestWithParam<Rejection> {};

TEST_P(ProbeGroupsJsonRejects, WithPlaceAndValue) {
    EXPECT_EQ(error_of(GetParam().text), std::string("groups.json: ") + GetParam().error);
}

const std::string kPositions = R"("positions": [[0, 0, 0]])";

const Rejection kRejections[] = {
    {"NoObject", "[]", "is not a JSON object"},
    {"NoGroups", "{}", "groups is missing"},
    {"GroupsNoArray", R"({"groups": 5})", "groups is not an array (5)"},
    {"UnknownTopKey", R"({"groups": [], "extra": 1})", "unknown key \"extra\""},
    {"GroupNoObject", R"({"groups": [7]})", "group 0: is not an object (7)"},
    {"NoName", R"({"groups": [{"positions": [[0,0,0]]}]})", "group 0: name is missing"},
    {"EmptyName", R"({"groups": [{"name": "", "positions": [[0,0,0]]}]})",
     "group 0: name is empty"},
    {"NameNoString", R"({"groups": [{"name": 3, "positions": [[0,0,0]]}]})",
     "group 0: name is not a string (3)"},
    {"SameName",
     R"({"groups": [{"name": "a", "positions": [[0,0,0]]}, {"name": "a", "positions": [[0,0,0]]}]})",
     "group 1: another group is named \"a\""},
    {"UnknownKey", hall_with(kPositions + R"(, "size": 1)"),
     "group \"hall\": unknown key \"size\""},
    {"KeyTwice", hall_with(kPositions + ", " + kPositions),
     "group \"hall\": key \"positions\" stands twice"},
    {"NoPositions", hall_with(R"("dering": true)"), "group \"hall\": positions is missing"},
    {"PositionsNoArray", hall_with(R"("positions": 4)"),
     "group \"hall\": positions is not an array (4)"},
    {"TwoNumbers", hall_with(R"("positions": [[0,0,0], [1, 2]])"),
     "group \"hall\": probe 1: position is not three numbers ([1,2])"},
    {"NullCoordinate", hall_with(R"("positions": [[0,0,0], [1, null, 2]])"),
     "group \"hall\": probe 1: position: y is not a number (null)"},
    {"StringCoordinate", hall_with(R"("positions": [[0, 0, "1"]])"),
     "group \"hall\": probe 0: position: z is not a number (\"1\")"},
    {"Overflow", hall_with(R"("positions": [[0,0,0], [1, 2, 1e999]])"),
     "group \"hall\": probe 1: is not finite: number overflow parsing '1e999'"},
    {"DeringNoBoolean", hall_with(kPositions + R"(, "dering": 1)"),
     "group \"hall\": dering is not a boolean (1)"},
    {"NoLayers", hall_with(kPositions + R"(, "rendering_layers": [])"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 ([])"},
    {"LayersNoArray", hall_with(kPositions + R"(, "rendering_layers": 3)"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 (3)"},
    {"Layer32", hall_with(kPositions + R"(, "rendering_layers": [0, 32])"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 ([0,32])"},
    {"NegativeLayer", hall_with(kPositions + R"(, "rendering_layers": [-1])"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 ([-1])"},
    {"FractionalLayer", hall_with(kPositions + R"(, "rendering_layers": [0.5])"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 ([0.5])"},
    {"LayerNoNumber", hall_with(kPositions + R"(, "rendering_layers": ["hall"])"),
     "group \"hall\": rendering_layers is not a list of rendering layers, 0 to 31 ([\"hall\"])"},
    {"ShortTransform", hall_with(kPositions + R"(, "transform": [1, 2])"),
     "group \"hall\": transform is not 16 numbers ([1,2])"},
    {"NullInTransform",
     hall_with(kPositions + R"(, "transform": [1,0,0,0, 0,null,0,0, 0,0,1,0, 0,0,0,1])"),
     "group \"hall\": transform: number 5 is not a number (null)"},
    {"Projective",
     hall_with(kPositions + R"(, "transform": [1,0,0,0.5, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
     "group \"hall\": transform is not affine: number 3 is 0.5, not 0"},
};

INSTANTIATE_TEST_SUITE_P(All, ProbeGroupsJsonRejects, testing::ValuesIn(kRejections),
                         [](const auto& param_info) {
                             return std::string(param_info.param.label);
                         });

TEST(ProbeGroupsJson, GroupsAndTheirProbesMayBeMissing) {
    const TempFolder folder;
    const auto none = read_probe_groups(folder.write("none.json", R"({"groups": []})"));
    ASSERT_TRUE(none) << error_text(none.error());
    EXPECT_TRUE(none->empty());
    const auto two = read_probe_groups(folder.write("two.json", hall_with(R"("positions": [])")));
    ASSERT_TRUE(two) << error_text(two.error());
    EXPECT_TRUE((*two)[1].positions.empty());
}

TEST(ProbeGroupsJson, RenderingLayersAreBitsOfTheMaskInAnyOrder) {
    const TempFolder folder;
    const std::string positions = R"(, "positions": [[0, 0, 0]])";
    for (const auto& [layers, mask] : {std::pair<std::string, uint32_t>("[0]", 1u),
                                       {"[3, 0, 3]", 0b1001u},
                                       {"[3.0, 0]", 0b1001u},
                                       {"[31]", 1u << 31}}) {
        const auto groups = read_probe_groups(
            folder.write("g.json", hall_with(R"("rendering_layers": )" + layers + positions)));
        ASSERT_TRUE(groups) << error_text(groups.error());
        EXPECT_EQ((*groups)[0].rendering_layers, kAllRenderingLayers);
        EXPECT_EQ((*groups)[1].rendering_layers, mask);
    }
}

TEST(ProbeGroupsJson, FilesOfOtherKindsAreNamed) {
    EXPECT_EQ(error_of("TETRAPV\n..."), "groups.json: is a probe volume, not a group file");
    EXPECT_EQ(error_of("glTF..."), "groups.json: is a binary glTF scene; its extension is .glb");
}

TEST(ProbeGroupsJson, NanTokenNamesGroupAndProbe) {
    const std::string error = error_of(hall_with(R"("positions": [[0,0,0], [NaN, 0, 0]])"));
    EXPECT_TRUE(error.starts_with("groups.json: group \"hall\": probe 1: parse error at line 1"))
        << error;
}

TEST(ProbeGroupsJson, EveryTruncationIsAnError) {
    const std::string whole = hall_with(R"("dering": true, "positions": [[0, 0, 0], [1, 2, 3]])");
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::string error = error_of(std::string_view(whole).substr(0, length));
        EXPECT_TRUE(error.starts_with("groups.json: ")) << length << ": " << error;
    }
}

TEST(ProbeGroupsJson, DeepNestingIsAnError) {
    const std::string deep = std::string(300000, '[') + std::string(300000, ']');
    for (const std::string& text :
         {std::string(300000, '['), deep, R"({"groups": )" + deep + "}",
          R"({"groups": [{"name": )" + deep + R"(, "positions": [[0, 0, 0]]}]})",
          hall_with("\"positions\": " + deep)}) {
        EXPECT_EQ(error_of(text), "groups.json: JSON is nested deeper than 64");
    }
}

TEST(ProbeGroupsJson, MissingFileIsNamed) {
    const auto groups = read_probe_groups("/nowhere/g.json");
    ASSERT_FALSE(groups);
    EXPECT_NE(error_text(groups.error()).find("/nowhere/g.json"), std::string::npos);
}

TEST(ProbeGroupsJson, WriterRefusesWhatReaderWouldRefuse) {
    const TempFolder folder;
    const std::string path = folder.path("g.json");
    EXPECT_FALSE(write_probe_groups(path, {}));
    EXPECT_FALSE(write_probe_groups(path, std::vector{one_probe({0, 0, 0}), one_probe({1, 1, 1})}));
    EXPECT_FALSE(write_probe_groups(
        path, std::vector{ProbeGroup{"\xff", glm::dmat4(1.0), {{0, 0, 0}}, false}}));
    const auto no_layer =
        write_probe_groups(path, std::vector{ProbeGroup{"a", glm::dmat4(1.0), {}, false, 0}});
    ASSERT_FALSE(no_layer);
    EXPECT_EQ(no_layer.error().field, "groups[0].rendering_layers");
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(ProbeGroupsJson, WriterNamesAPositionThatIsNotFinite) {
    const TempFolder folder;
    const std::vector<ProbeGroup> groups = {one_probe({std::nan(""), 0, 1})};
    const auto status = write_probe_groups(folder.path("g.json"), groups);
    ASSERT_FALSE(status);
    EXPECT_EQ(
        error_text(status.error()),
        folder.path("g.json") + ": group \"hall\": probe 0: position is not finite (nan, 0, 1)");
}

}  // namespace
}  // namespace tetralight
