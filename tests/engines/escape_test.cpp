// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/escape.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

TEST(Escape, QuotesForGodotAndCSharp) {
    for (const auto quoted : {quoted_for_godot, quoted_for_csharp}) {
        EXPECT_EQ(quoted(""), "\"\"");
        EXPECT_EQ(quoted("a \"b\" \\ c"), "\"a \\\"b\\\" \\\\ c\"");
        EXPECT_EQ(quoted("line\nbreak\x7F"), "\"line\\u000abreak\\u007f\"");
        EXPECT_EQ(quoted("caf\xC3\xA9"), "\"caf\xC3\xA9\"");
        EXPECT_EQ(quoted("C1 \xC2\x85"), "\"C1 \\u0085\"");
        EXPECT_EQ(quoted("bad \xFF."), "\"bad \xEF\xBF\xBD.\"");
    }
}

TEST(Escape, QuotesForRon) {
    EXPECT_EQ(quoted_for_ron("a\"\\\t"), "\"a\\\"\\\\\\u{0009}\"");
}

TEST(Escape, MakesXmlOfMarkup) {
    EXPECT_EQ(escaped_for_xml("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&apos;");
    EXPECT_EQ(escaped_for_xml(std::string_view("\0\x1B", 2)), "\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(escaped_for_xml("\xEF\xBF\xBF"), "\xEF\xBF\xBD");
}

TEST(Escape, KeepsSpreadsheetsFromFormulas) {
    for (const std::string start : {"=", "+", "-", "@"}) {
        EXPECT_EQ(escaped_for_csv(start + "1+1"), "'" + start + "1+1");
    }
    EXPECT_EQ(escaped_for_csv("\tx"), "'\tx");
    EXPECT_EQ(escaped_for_csv("\rx"), "\"'\rx\"");
    EXPECT_EQ(escaped_for_csv("  =1"), "'  =1");
    EXPECT_EQ(escaped_for_csv("room 1"), "room 1");
}

TEST(Escape, QuotesFieldsOfCsv) {
    EXPECT_EQ(escaped_for_csv("a,b"), "\"a,b\"");
    EXPECT_EQ(escaped_for_csv("say \"hi\""), "\"say \"\"hi\"\"\"");
    EXPECT_EQ(escaped_for_csv("two\nlines"), "\"two\nlines\"");
}

RC_GTEST_PROP(Escape, GivesUtf8OfAnyBytes, (const std::string& text)) {
    for (const auto escape : {quoted_for_json, quoted_for_godot, quoted_for_csharp, quoted_for_ron,
                              escaped_for_xml, escaped_for_csv}) {
        RC_ASSERT(is_utf8(escape(text)));
    }
}

/// Godot's strings have the escapes of JSON.
RC_GTEST_PROP(Escape, JsonReadsBackAscii, ()) {
    const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(0, 127));
    RC_ASSERT(nlohmann::json::parse(quoted_for_json(text)).get<std::string>() == text);
    RC_ASSERT(nlohmann::json::parse(quoted_for_godot(text)).get<std::string>() == text);
}

}  // namespace
}  // namespace tetralight
