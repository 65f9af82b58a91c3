// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tetralight::bench {

/// Does `count` multiply-adds, all in registers, as fast as this thread can: twelve independent
/// chains of fused multiply-adds in the widest vectors. Gives a number that depends on all of them.
float multiply_add(size_t count);

}  // namespace tetralight::bench
