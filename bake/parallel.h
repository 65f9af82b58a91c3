// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tetralight {

/// Calls `work(i)` once for each i < count on `thread_count` threads (0 = all), and returns after
/// the last call. Each thread flushes denormal numbers to zero, as Embree recommends, so that the
/// results do not depend on the thread. A call should take some microseconds or more.
void parallel_for(size_t count, uint32_t thread_count, const std::function<void(size_t)>& work);

}  // namespace tetralight
