// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Benchmarks of the HTTP service. Runs the `tetralight` program in the folder of this one.
void bench_server(const Options& options);

}  // namespace tetralight::bench
