// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight::bench {

/// Number of GPU query results, of a million, that differ from the CPU's.
void bench_gpu_query();

}  // namespace tetralight::bench
