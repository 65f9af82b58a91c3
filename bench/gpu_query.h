// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight::bench {

/// Answers of the GPU's query that differ from the CPU's, of a million.
void bench_gpu_query();

}  // namespace tetralight::bench
