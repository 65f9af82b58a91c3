// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <limits>

namespace tetralight {
namespace {

TEST(Text, JoinsStringsAndNumbers) {
    EXPECT_EQ(str_cat("probe ", 7u, ": ", 0.5, " of ", std::string("hall")),
              "probe 7: 0.5 of hall");
}

TEST(Text, WritesACharacterAsItself) {
    EXPECT_EQ(str_cat('x', 1), "x1");
}

TEST(Text, SaysNumbersThatAreNotFinite) {
    EXPECT_EQ(str_cat(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(str_cat(std::numeric_limits<double>::quiet_NaN()), "nan");
}

RC_GTEST_PROP(Text, WritesDoublesThatReadBackTheSame, (double value)) {
    RC_ASSERT(std::stod(str_cat(value)) == value);
}

}  // namespace
}  // namespace tetralight
