// SPDX-License-Identifier: Apache-2.0
#include <tetralight/batch/limits.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>

namespace tetralight {
namespace {

using settings::Json;

TEST(Limits, AreNumbers) {
    const auto limits =
        read_limits({{"error", "2%"}, {"dead_probes", 0.5}, {"leak", nullptr}, {"seconds", "2m"}});
    ASSERT_TRUE(limits);
    EXPECT_EQ(*limits, (Json{{"error", 0.02}, {"dead_probes", 0.5}, {"seconds", 120.0}}));
}

TEST(Limits, WrongOnesAreNamed) {
    for (const Json& wrong : {Json{{"eror", 1}}, Json{{"error", 2}}, Json{{"error", "much"}},
                              Json{{"seconds", 0}}, Json::array(), Json(3)}) {
        const auto limits = read_limits(wrong);
        ASSERT_FALSE(limits) << wrong;
        EXPECT_EQ(limits.error().code, ErrorCode::InvalidArgument);
        EXPECT_TRUE(error_text(limits.error()).starts_with("limits")) << error_text(limits.error());
    }
}

TEST(Limits, AreOfSomeKindsOfLight) {
    EXPECT_TRUE(is_limited("error", "lightmaps"));
    EXPECT_FALSE(is_limited("error", "reflections"));
    EXPECT_TRUE(is_limited("leak", "probes"));
    EXPECT_FALSE(is_limited("leak", "lightmaps"));
    EXPECT_FALSE(is_limited("seconds", "probes"));  // of the scene
}

}  // namespace
}  // namespace tetralight
