// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// The HTTP service, by the `tetralight` program beside this one.
void bench_server(const Options& options);

}  // namespace tetralight::bench
