// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/memory.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

constexpr uint64_t kMost = ~uint64_t{0};

TEST(Memory, AddBytesStopsAtTheLargestNumber) {
    EXPECT_EQ(add_bytes(1, 2, 3), 7u);
    EXPECT_EQ(add_bytes(5, kMost, 0), 5u);
    EXPECT_EQ(add_bytes(kMost - 6, 2, 3), kMost);
    EXPECT_EQ(add_bytes(kMost - 5, 2, 3), kMost);
    EXPECT_EQ(add_bytes(kMost - 7, 2, 3), kMost - 1);
    EXPECT_EQ(add_bytes(0, kMost, kMost), kMost);
}

TEST(Memory, GigabytesAreToATenth) {
    EXPECT_EQ(gigabytes(uint64_t{20'349'999'999}), "20.3 GB");
    EXPECT_EQ(gigabytes(49'999'999.0), "0 GB");
}

TEST(Memory, SomeIsFree) {
    EXPECT_GT(free_memory(), 50'000'000u);
}

}  // namespace
}  // namespace tetralight
