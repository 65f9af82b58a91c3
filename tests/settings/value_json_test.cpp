// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/value_json.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>

namespace tetralight::settings {
namespace {

constexpr Setting kSeed{.name = "s", .type = Type::Integer, .range = kAnyInteger};
constexpr Setting kPath{.name = "p", .type = Type::Path, .extensions = ".png .exr"};
constexpr Setting kChoice{.name = "c", .type = Type::Choice, .choices = "one two"};

TEST(ValueJson, KeepsAllBitsOfASeed) {
    EXPECT_EQ(*value_from_json(kSeed, Json(UINT64_MAX)), Json(UINT64_MAX));
    EXPECT_FALSE(value_from_json(kSeed, Json(-1)));
    EXPECT_FALSE(value_from_json(kSeed, Json(1.5)));
    EXPECT_FALSE(value_from_json(kSeed, Json("1")));
}

TEST(ValueJson, TextsHaveNoControlCharacters) {
    EXPECT_FALSE(value_from_json(kPath, Json("a\nb")));
    EXPECT_FALSE(value_from_json(kPath, Json(std::string("a\0b", 3))));
}

TEST(ValueJson, NamesTheWordsOfAChoice) {
    EXPECT_EQ(*value_from_json(kChoice, Json("two")), Json("two"));
    const auto number = value_from_json(kChoice, Json(2));
    ASSERT_FALSE(number);
    EXPECT_EQ(error_text(number.error()), "\"2\" is not one of \"one\", \"two\"");
}

TEST(ValueJson, ShowsLongValuesShortened) {
    EXPECT_EQ(shown_value(Json::array({1, 2})), "[1,2]");
    EXPECT_EQ(shown_value(Json("word")), "word");
    EXPECT_LT(shown_value(Json(std::string(10'000, 'x'))).size(), 300u);
}

}  // namespace
}  // namespace tetralight::settings
