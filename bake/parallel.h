// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tetralight {

/// Calls `work(i)` once for every i < count on `thread_count` threads (0 = all), and returns when
/// all are done. Denormal numbers count as zero in every thread, as Embree's authors advise, so
/// that results do not depend on the thread. Each call should be worth some microseconds.
void parallel_for(size_t count, uint32_t thread_count, const std::function<void(size_t)>& work);

}  // namespace tetralight
