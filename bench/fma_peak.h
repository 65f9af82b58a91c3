// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tetralight::bench {

/// Executes `count` multiply-adds in registers at the peak rate of this thread: twelve independent
/// chains of fused multiply-adds in the widest vectors. Returns a number that depends on all of
/// them.
float multiply_add(size_t count);

}  // namespace tetralight::bench
