// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <limits>

namespace tetralight {
namespace {

TEST(Text, JoinsStringsAndNumbers) {
    EXPECT_EQ(text("probe ", 7u, ": ", 0.5, " of ", std::string("hall")), "probe 7: 0.5 of hall");
}

TEST(Text, WritesACharacterAsItself) {
    EXPECT_EQ(text('x', 1), "x1");
}

TEST(Text, SaysNumbersThatAreNotFinite) {
    EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

RC_GTEST_PROP(Text, WritesDoublesThatReadBackTheSame, (double value)) {
    RC_ASSERT(std::stod(text(value)) == value);
}

}  // namespace
}  // namespace tetralight
