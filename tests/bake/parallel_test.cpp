// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <vector>

namespace tetralight {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
    for (const uint32_t thread_count : {0u, 1u, 3u}) {
        std::vector<std::atomic<int>> calls(1000);
        parallel_for(calls.size(), thread_count, [&](size_t i) { ++calls[i]; });
        for (const auto& count : calls) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelFor, OfNothingReturns) {
    parallel_for(0, 2, [](size_t) { FAIL(); });
}

TEST(ParallelFor, DenormalsAreZeroInsideAndAsBeforeOutside) {
    volatile float smallest = std::numeric_limits<float>::min();
    const auto is_flushed = [&] { return smallest * 0.5f == 0.0f; };
    std::atomic<int> flushed = 0;
    parallel_for(100, 2, [&](size_t) { flushed += is_flushed(); });
    EXPECT_EQ(flushed, 100);
    EXPECT_FALSE(is_flushed());
}

}  // namespace
}  // namespace tetralight
