// SPDX-License-Identifier: Apache-2.0
// The corpus, and a fixed number of cases of each target; `./run fuzz NAME SECONDS` runs more.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/fuzz/targets.h"

namespace tetralight::fuzz {
namespace {

class Fuzz : public testing::TestWithParam<Target> {};

INSTANTIATE_TEST_SUITE_P(All, Fuzz, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Fuzz, FindsNothing) {
    constexpr uint64_t kCaseCount = 3000;
    for (uint64_t seed = 1; seed <= kCaseCount; ++seed) {
        ASSERT_EQ(GetParam().run(seed), "") << "seed " << seed;
    }
}

TEST_P(Fuzz, TakesNothingOfTheCorpusWronglyAgain) {
    const std::string folder = TETRALIGHT_FUZZ_CORPUS "/" + std::string(GetParam().name);
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        EXPECT_EQ(GetParam().replay(entry.path().string()), "") << entry.path();
        ++count;
    }
    EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace tetralight::fuzz
