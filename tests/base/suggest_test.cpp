// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/suggest.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tetralight {
namespace {

const std::vector<std::string> kNames = {"--samples", "--seed", "--sky", "--max-samples"};

TEST(Suggest, FindsAMisspelledWord) {
    for (const char* word : {"--sample", "--sampels", "--smaples", "--sampless", "--Samples"}) {
        EXPECT_EQ(closest(word, kNames), "--samples") << word;
    }
}

TEST(Suggest, FindsTheWordThatIsOnlyBegun) {
    EXPECT_EQ(closest("--max", kNames), "--max-samples");
}

TEST(Suggest, SaysNothingIfNoneIsNear) {
    EXPECT_EQ(closest("--frobnicate", kNames), "");
    EXPECT_EQ(closest("", kNames), "");
    EXPECT_EQ(did_you_mean("--frobnicate", kNames), "");
    EXPECT_EQ(did_you_mean("--skye", kNames), "; did you mean --sky?");
}

}  // namespace
}  // namespace tetralight
