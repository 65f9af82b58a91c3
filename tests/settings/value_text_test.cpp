// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/value_text.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFraction{.name = "f", .type = Type::Fraction};
constexpr Setting kTime{.name = "t", .type = Type::Seconds};
constexpr Setting kRange{.name = "r", .type = Type::Range};
constexpr Setting kSeed{.name = "s", .type = Type::Integer, .range = kAnyInteger};
constexpr Setting kScale{.name = "s", .type = Type::Scale, .range = kLengths};
constexpr Setting kSky{.name = "s", .type = Type::Sky, .range = kRadiance};
constexpr Setting kPath{.name = "p", .type = Type::Path, .extensions = ".png .exr"};

std::string refusal(const Setting& setting, std::string_view text) {
    const auto value = value_from_text(setting, text);
    return value ? "" : error_text(value.error());
}

TEST(ValueText, ReadsFractionsAndPercentages) {
    EXPECT_EQ(*value_from_text(kFraction, "1%"), Json(0.01));
    EXPECT_EQ(*value_from_text(kFraction, "0.01"), Json(0.01));
    for (const char* wrong : {"0", "0%", "101%", "1.5", "-1%", "%", "1%%", "nan", ""}) {
        EXPECT_FALSE(value_from_text(kFraction, wrong)) << wrong;
    }
}

TEST(ValueText, ReadsTimes) {
    EXPECT_EQ(*value_from_text(kTime, "90"), Json(90.0));
    EXPECT_EQ(*value_from_text(kTime, "90s"), Json(90.0));
    EXPECT_EQ(*value_from_text(kTime, "1.5m"), Json(90.0));
    EXPECT_EQ(*value_from_text(kTime, "2h"), Json(7200.0));
    for (const char* wrong : {"0", "-1s", "s", "1d", "1e9", "inf", ""}) {
        EXPECT_FALSE(value_from_text(kTime, wrong)) << wrong;
    }
}

TEST(ValueText, ReadsRangesOfElements) {
    EXPECT_EQ(*value_from_text(kRange, "100..200"), Json::array({100, 200, 1}));
    EXPECT_EQ(*value_from_text(kRange, "100.."), Json::array({100, 4294967295, 1}));
    EXPECT_EQ(*value_from_text(kRange, "3..200x8"), Json::array({3, 200, 8}));
    EXPECT_EQ(*value_from_text(kRange, "3..x8"), Json::array({3, 4294967295, 8}));
    for (const char* wrong :
         {"..3", "3", "3..3", "4..3", "a..b", "1...2", "-1..2", "0..4294967296", "0..9x", "0..9x0",
          "0..9x-1", "0x2", "0..x", "0..9x4294967296", "0..9x2x2"}) {
        EXPECT_FALSE(value_from_text(kRange, wrong)) << wrong;
    }
}

TEST(ValueText, KeepsAllBitsOfASeed) {
    EXPECT_EQ(*value_from_text(kSeed, "18446744073709551615"), Json(UINT64_MAX));
    EXPECT_EQ(refusal(kSeed, "18446744073709551616"),
              "\"18446744073709551616\" is not a whole number from 0 to 2^64 - 1");
}

TEST(ValueText, ANumberStandsForAllThreeOfAScale) {
    EXPECT_EQ(*value_from_text(kScale, "2"), Json::array({2.0, 2.0, 2.0}));
    EXPECT_EQ(*value_from_text(kScale, "1,2,3"), Json::array({1.0, 2.0, 3.0}));
    EXPECT_EQ(refusal(kScale, "two"), "\"two\" is not a number or x,y,z");
    EXPECT_EQ(refusal(kScale, "0"), "0 is not in the range 1e-6 to 1e9");
}

TEST(ValueText, ASkyIsANumberAColorOrAFile) {
    EXPECT_EQ(*value_from_text(kSky, "0.5"), Json(0.5));
    EXPECT_EQ(*value_from_text(kSky, "1,2,3"), Json::array({1.0, 2.0, 3.0}));
    EXPECT_EQ(*value_from_text(kSky, "dusk.exr"), Json("dusk.exr"));
    for (const char* wrong : {"", "1,2", "1,2,3,4", "-1", "nan,0,0", "2e30"}) {
        EXPECT_FALSE(value_from_text(kSky, wrong)) << wrong;
    }
}

TEST(ValueText, ChecksTheExtensionOfAFileToWrite) {
    for (const char* right : {"a.png", "a.EXR", "a", "-"}) {
        EXPECT_TRUE(value_from_text(kPath, right)) << right;
    }
    EXPECT_EQ(refusal(kPath, ""), "the path is empty");
    EXPECT_EQ(refusal(kPath, "a.jpg"),
              "cannot write \".jpg\" files; the extension may be .png, .exr, or none");
}

}  // namespace
}  // namespace tetralight::settings
