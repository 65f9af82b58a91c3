// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <mutex>
#include <type_traits>

// As libc++ says since version 20 that it has no threads.
#undef _LIBCPP_HAS_THREADS
#define _LIBCPP_HAS_THREADS 0
#include <tetralight/base/mutex.h>

namespace tetralight {
namespace {

TEST(Mutex, DoesNothingWithoutThreads) {
    EXPECT_TRUE(std::is_empty_v<Mutex>);
}

}  // namespace
}  // namespace tetralight
