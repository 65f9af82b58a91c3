// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// How far light on the surface of long objects is from what each of its points would look up
/// itself: in the scene of the options, else in the courtyard.
void bench_lppv_accuracy(const Options& options);

}  // namespace tetralight::bench
