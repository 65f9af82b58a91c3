// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Error of a proxy volume's light on the surface of long objects, against a query at each point of
/// the surface: in the scene of the options, else in the courtyard.
void bench_lppv_accuracy(const Options& options);

}  // namespace tetralight::bench
