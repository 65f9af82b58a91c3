// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/shown_path.h>

#include <gtest/gtest.h>

#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

TEST(ShownPath, KeepsWhatCanBeRead) {
    EXPECT_EQ(shown_path("a b/\"c\".probes"), "a b/\"c\".probes");
    EXPECT_EQ(shown_path("gr\xc3\xbc\xc3\x9f"
                         "e.probes"),
              "gr\xc3\xbc\xc3\x9f"
              "e.probes");
}

TEST(ShownPath, StaysInOneLineAndCommandsNoTerminal) {
    EXPECT_EQ(shown_path("a\nb\x1b[31m\x7f"), "a\\x0ab\\x1b[31m\\x7f");
    EXPECT_EQ(shown_path("\xffz"), "\\xffz");
    EXPECT_EQ(shown_path(""), "\"\"");
}

TEST(ShownPath, LosesItsMiddleWhenItIsLong) {
    const std::string path = "/begin/" + std::string(1000, 'x') + "/end.probes";
    const std::string shown = shown_path(path);
    EXPECT_LE(shown.size(), 300u);
    EXPECT_TRUE(shown.starts_with("/begin/xx") && shown.ends_with("xx/end.probes"));
    EXPECT_NE(shown.find("x...x"), std::string::npos);
}

TEST(ShownPath, CutsNoCharacterInTwo) {
    for (const char* begin : {"", "a", "aa"}) {
        std::string path = begin;
        for (int i = 0; i < 400; ++i) path += "\xe2\x82\xac";
        EXPECT_TRUE(is_utf8(shown_path(path)));
        EXPECT_LE(shown_path(path).size(), 300u);
    }
}

}  // namespace
}  // namespace tetralight
