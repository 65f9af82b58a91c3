// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/setting.h>

#include <gtest/gtest.h>

namespace tetralight::settings {
namespace {

TEST(Setting, WritesNumbersAsPeopleDo) {
    EXPECT_EQ(number_text(0.25), "0.25");
    EXPECT_EQ(number_text(1e30), "1e30");
    EXPECT_EQ(number_text(1e-6), "1e-6");
    EXPECT_EQ(number_text(1e9), "1e9");
    EXPECT_EQ(number_text(16777216), "16777216");
    EXPECT_EQ(number_text(0x1p64), "2^64 - 1");
}

TEST(Setting, WritesRangesAsPeopleDo) {
    EXPECT_EQ(range_text({0, 1}), "0 to 1");
    EXPECT_EQ(range_text({0, 1, true}), "above 0, up to 1");
    EXPECT_EQ(range_text({.min = 0}), "0 or more");
    EXPECT_EQ(range_text({.min = 0, .excludes_min = true}), "above 0");
    EXPECT_EQ(range_text({}), "");
}

TEST(Setting, OptionsHaveDashesAndPositionalArgumentsCapitals) {
    EXPECT_EQ(shown_name(*kBake.find("sun_direction"), Form::Options), "--sun-direction");
    EXPECT_EQ(shown_name(*kBake.find("sun_direction"), Form::Json), "sun_direction");
    EXPECT_EQ(shown_name(*kBake.find("scene"), Form::Options), "SCENE");
}

TEST(Setting, TablesAreFoundByTheirCommand) {
    EXPECT_EQ(find_table("bake"), &kBake);
    EXPECT_EQ(find_table("cook"), nullptr);
    EXPECT_EQ(kBake.find("nothing"), nullptr);
}

}  // namespace
}  // namespace tetralight::settings
