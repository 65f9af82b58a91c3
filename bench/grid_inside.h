// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/grid_scenes.h"
#include "bench/harness.h"

namespace tetralight::bench {

/// Who is told to be inside of a scene's geometry, against what is, and how fast.
void measure_inside(const GridSubject& subject, const Options& options);

}  // namespace tetralight::bench
