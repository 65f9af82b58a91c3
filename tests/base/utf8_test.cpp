// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/base/utf8.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

TEST(Utf8, TakesTheFirstAndLastCharacterOfEachLength) {
    for (const char* text :
         {"", "\x01", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
          "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "a\xc3\xa4z"}) {
        EXPECT_TRUE(is_utf8(text)) << text;
    }
}

TEST(Utf8, RefusesOverlongFormsSurrogatesAndWhatIsCutOff) {
    for (const char* bytes :
         {"\x80", "\xff", "a\xff", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80",
          "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xc3", "\xe2\x82",
          "\xf0\x9f\x92", "\xc3(", "\xe2\x82(", "\xf0\x9f\x92("}) {
        EXPECT_FALSE(is_utf8(bytes)) << bytes;
    }
}

TEST(Utf8, RefusesNamesWithControlCharactersOrOtherBytes) {
    EXPECT_TRUE(check_characters("Lampe \xc3\xa4"));
    EXPECT_TRUE(
        check_characters("20\xc2\xa0"
                         "m\xc2\xb2"));  // the first character after C1 is a space
    for (const char* name : {"a\nb", "a\tb", "\x7f",
                             "a\xc2\x9b"
                             "31m"}) {
        EXPECT_EQ(error_text(check_characters(name).error()),
                  "the name holds a line break or another control character");
    }
    EXPECT_EQ(error_text(check_characters("\xff").error()), "the name is not UTF-8");
}

TEST(Utf8, ControlsBecomeEscapes) {
    EXPECT_EQ(without_controls("a\nb\x1b[31m\x7f"), "a\\u000ab\\u001b[31m\\u007f");
    EXPECT_EQ(without_controls("\xc2\x85"), "\\u0085");
    const std::pair<const char*, const char*> marks[] = {
        {"\u200e", "\\u200e"}, {"\u200f", "\\u200f"}, {"\u202a", "\\u202a"},
        {"\u202e", "\\u202e"}, {"\u2066", "\\u2066"}, {"\u2069", "\\u2069"}};
    for (const auto& [mark, escape] : marks)
        EXPECT_EQ(without_controls(std::string("a") + mark + "b"), std::string("a") + escape + "b");
    for (const char* text :
         {"", "W\u00fcrfel \u00a0 \u200d\u2029\u202f\u2065\u206a \U0001f600", "\xff\xe2\x80"})
        EXPECT_EQ(without_controls(text), text);
}

TEST(Utf8, ControlsOfNamesBecomeBlanks) {
    EXPECT_EQ(with_blanks_for_controls("tab\tnew\nline\x7f\xc2\x85."), "tab new line  .");
    EXPECT_EQ(with_blanks_for_controls("W\u00fcrfel\u202e"), "W\u00fcrfel\u202e");
    EXPECT_FALSE(has_control_character(with_blanks_for_controls("\r\n\xc2\x9f")));
}

}  // namespace
}  // namespace tetralight
