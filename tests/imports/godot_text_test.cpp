// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/godot_text.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>

namespace tetralight::detail {
namespace {

std::vector<GodotEntry> entries_of(std::string_view text) {
    GodotText reader(text);
    std::vector<GodotEntry> entries;
    while (true) {
        const auto entry = reader.next();
        EXPECT_TRUE(entry) << error_text(entry.error());
        if (!entry || !*entry) return entries;
        entries.push_back(**entry);
    }
}

std::string text_error(std::string_view text) {
    GodotText reader(text);
    while (true) {
        const auto entry = reader.next();
        if (!entry) return error_text(entry.error());
        if (!*entry) return "(no error)";
    }
}

std::string transform_error(std::string_view value) {
    const auto transform = parse_godot_transform(value);
    return transform ? "(no error)" : error_text(transform.error());
}

TEST(GodotText, SplitsHeadingsIntoAttributes) {
    const auto entries = entries_of(
        "; a comment\n[node name=\"A ]\\\" b\" groups=[\"x\", \"y\"] instance=ExtResource( \"1\" "
        ")]\n");
    ASSERT_EQ(entries.size(), 1u);
    EXPECT_TRUE(entries[0].is_heading);
    EXPECT_EQ(entries[0].name, "node");
    EXPECT_EQ(entries[0].line, 2u);
    EXPECT_EQ(**entries[0].text_attribute("name"), "A ]\" b");
    EXPECT_EQ(entries[0].attribute("groups"), "[\"x\", \"y\"]");
    EXPECT_EQ(entries[0].attribute("instance"), "ExtResource( \"1\" )");
    EXPECT_EQ(entries[0].attribute("parent"), std::nullopt);
}

TEST(GodotText, ValuesMaySpanLines) {
    const auto entries = entries_of(
        "a = {\n\"k]\": [1,\n2]\n}\ntext = \"two\nlines = 3\"\n\"odd name\" = &\"b\"\nlast = 1");
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0].value, "{\n\"k]\": [1,\n2]\n}");
    EXPECT_EQ(entries[1].name, "text");
    EXPECT_EQ(entries[1].line, 5u);
    EXPECT_EQ(entries[2].name, "\"odd name\"");
    EXPECT_EQ(entries[2].line, 7u);
    EXPECT_EQ(entries[3].value, "1");
}

TEST(GodotText, ErrorsNameTheLine) {
    EXPECT_EQ(text_error("\na = \"b\n\nc"), "2: the string that begins here does not end");
    EXPECT_EQ(text_error("a = (\n[1"), "1: a bracket of the value is not closed");
    EXPECT_EQ(text_error("a = 1)\n"), "1: ')' closes no bracket");
    EXPECT_EQ(text_error("a = 1\nhello\n"), "2: \"hello\" is neither a heading nor a property");
    EXPECT_EQ(text_error("[node name=\"a\""), "1: the heading does not end");
    EXPECT_EQ(text_error("[node name]"), "1: heading \"node\": \"name\" is not an attribute");
}

TEST(GodotText, StringsHaveEscapes) {
    EXPECT_EQ(parse_godot_string(R"("a\"b\\c\n\u00e4\U01f600")"),
              "a\"b\\c\n\xc3\xa4\xf0\x9f\x98\x80");
    for (const char* wrong :
         {"a", "\"", "\"a\\u00\"", "\"a\\ud800\"", "\"a\\U110000\"", "\"a\"b\""})
        EXPECT_EQ(parse_godot_string(wrong), std::nullopt) << wrong;
}

TEST(GodotText, TransformsHaveTheRowsOfTheBasisAndTheOrigin) {
    const auto transform =
        parse_godot_transform("Transform3D(1, 2, 3, 4, 5, 6, 7, 8, 9, -1.5, 2e1, 0.25)");
    ASSERT_TRUE(transform);
    // The row of x, times a position.
    const glm::dvec4 p = *transform * glm::dvec4(1, 10, 100, 1);
    EXPECT_EQ(p.x, 1 + 20 + 300 - 1.5);
    EXPECT_EQ(p.y, 4 + 50 + 600 + 20.0);
    EXPECT_EQ(p.z, 7 + 80 + 900 + 0.25);
}

TEST(GodotText, ErrorsOfTransformsNameTheNumber) {
    EXPECT_EQ(transform_error("Vector3(1, 2, 3)"),
              "transform is not a Transform3D (\"Vector3(1, 2, 3)\")");
    EXPECT_EQ(transform_error("Transform3D(1, 2)"),
              "transform does not have 12 numbers (\"Transform3D(1, 2)\")");
    EXPECT_EQ(transform_error("Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, nan, 0, 0)"),
              "transform: number 9 is not finite (\"nan\")");
    EXPECT_EQ(transform_error("Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0)").substr(0, 34),
              "transform does not have 12 numbers");
    EXPECT_EQ(transform_error("Transform3D(1, 0, x, 0, 1, 0, 0, 0, 1, 0, 0, 0)"),
              "transform: number 2 is not a number (\"x\")");
}

}  // namespace
}  // namespace tetralight::detail
